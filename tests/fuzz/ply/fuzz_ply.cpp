// PLY files, text and binary, byte by byte.
#include <array>
#include <cstring>

#include "fuzz/fuzz_mesh.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scree::fuzz::read_as_mesh(data, size, ".ply");
  return 0;
}

void scree::fuzz::write_seeds(const std::filesystem::path& folder) {
  const TriangleMesh brick = box_mesh({1, 2, 3});
  std::ofstream text{folder / "text.ply"};
  std::ofstream binary{folder / "binary.ply", std::ios::binary};
  for (const auto& [out, format] : {std::pair{&text, "ascii"}, {&binary, "binary_little_endian"}}) {
    *out << "ply\nformat " << format << " 1.0\ncomment a brick\nelement vertex " << brick.vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << brick.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
  }
  const auto put = [&](const auto& value) {
    std::array<char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    binary.write(bytes.data(), sizeof value);
  };
  for (const Vec3& p : brick.vertices) {
    text << p.x << " " << p.y << " " << p.z << "\n";
    for (int k = 0; k < 3; ++k) put(static_cast<float>(p[k]));
  }
  for (const Triangle& t : brick.triangles) {
    text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    put(std::uint8_t{3});
    for (const std::uint32_t v : t) put(static_cast<std::int32_t>(v));
  }
}
