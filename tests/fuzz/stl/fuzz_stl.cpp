// STL files, text and binary, byte by byte.
#include <array>
#include <cstring>

#include "fuzz/fuzz_mesh.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scree::fuzz::read_as_mesh(data, size, ".stl");
  return 0;
}

void scree::fuzz::write_seeds(const std::filesystem::path& folder) {
  const TriangleMesh brick = box_mesh({1, 2, 3});
  std::ofstream text{folder / "text.stl"};
  std::ofstream binary{folder / "binary.stl", std::ios::binary};
  const auto put = [&](const auto& value) {
    std::array<char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    binary.write(bytes.data(), sizeof value);
  };
  text << "solid brick\n";
  binary << std::string(80, ' ');
  put(static_cast<std::uint32_t>(brick.triangles.size()));
  for (const Triangle& t : brick.triangles) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) put(0.0F);
    for (const std::uint32_t v : t) {
      const Vec3& p = brick.vertices[v];
      text << "vertex " << p.x << " " << p.y << " " << p.z << "\n";
      for (int k = 0; k < 3; ++k) put(static_cast<float>(p[k]));
    }
    put(std::uint16_t{0});
    text << "endloop\nendfacet\n";
  }
  text << "endsolid brick\n";
}
