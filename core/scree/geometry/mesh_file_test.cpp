#include "scree/geometry/mesh_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/geometry/mass_properties.hpp"

namespace scree {
namespace {

/// A folder of its own for each test, removed at its end.
class MeshFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::temp_directory_path() / ("scree_mesh_" + std::to_string(::getpid()) + "_" + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream{folder_ / name, std::ios::binary} << text;
    return folder_ / name;
  }
  void expect_refused(const std::filesystem::path& file, ErrorKind kind, const std::string& words) const {
    try {
      (void)read_mesh_file(file);
      ADD_FAILURE() << file << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      EXPECT_NE(std::string{error.what()}.find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string{error.what()}.find(file.filename().string()), std::string::npos) << error.what();
    }
  }

  std::filesystem::path folder_;
};

const TriangleMesh kBrick = box_mesh({1, 2, 3});

std::string as_text_stl() {
  std::string text = "solid brick\n";
  for (const Triangle& t : kBrick.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : t) {
      const Vec3& p = kBrick.vertices[v];
      text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid brick\n";
}

std::string as_binary_stl() {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(kBrick.triangles.size()));
  for (const Triangle& t : kBrick.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0f);
    for (const std::uint32_t v : t) {
      for (int axis = 0; axis < 3; ++axis) put(static_cast<float>(kBrick.vertices[v][axis]));
    }
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string corners(const char* prefix) {
  std::string text;
  for (const Vec3& p : kBrick.vertices) {
    text += prefix + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  return text;
}

void expect_brick(const TriangleMesh& mesh, double scale) {
  EXPECT_EQ(mesh.vertices.size(), 8u);
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.is_solid()) << report.problem();
  // Small whole numbers are exact in the single precision of the files.
  EXPECT_NEAR(report.volume / (48.0 * scale * scale * scale), 1.0, 1e-12);
}

TEST_F(MeshFile, reads_text_and_binary_stl) {
  expect_brick(read_mesh_file(write("text.stl", as_text_stl())), 1.0);
  expect_brick(read_mesh_file(write("binary.STL", as_binary_stl())), 1.0);
}

TEST_F(MeshFile, reads_obj_and_cuts_its_polygons) {
  const std::string quads = "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";
  expect_brick(read_mesh_file(write("brick.obj", corners("v ") + quads)), 1.0);
}

TEST_F(MeshFile, reads_ply) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 12\nproperty list uchar int vertex_indices\nend_header\n" +
      corners("");
  for (const Triangle& t : kBrick.triangles) {
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  }
  expect_brick(read_mesh_file(write("brick.ply", text)), 1.0);
}

// A pyramid over a unit square, one high: its base is a face of four corners, and each vertex has a property more.
TEST_F(MeshFile, reads_binary_ply_of_either_byte_order) {
  constexpr std::array<std::array<float, 4>, 5> kCorners{
      {{0, 0, 0, 9}, {1, 0, 0, 9}, {1, 1, 0, 9}, {0, 1, 0, 9}, {0.5F, 0.5F, 1, 9}}};
  const std::vector<std::vector<std::int32_t>> faces{{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  for (const bool big : {false, true}) {
    std::string bytes = std::string{"ply\r\nformat binary_"} + (big ? "big" : "little") +
                        "_endian 1.0\r\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                        "property float quality\nelement face 5\nproperty list uchar int vertex_index\nend_header\n";
    const auto put = [&](const auto& value) {
      const auto* begin = reinterpret_cast<const char*>(&value);
      std::string part{begin, begin + sizeof value};
      if (big) std::reverse(part.begin(), part.end());  // the tests run on machines that put the low byte first
      bytes += part;
    };
    for (const auto& corner : kCorners) {
      for (const float x : corner) put(x);
    }
    for (const auto& face : faces) {
      put(static_cast<std::uint8_t>(face.size()));
      for (const std::int32_t corner : face) put(corner);
    }
    const TriangleMesh mesh = read_mesh_file(write("pyramid.ply", bytes));
    EXPECT_EQ(mesh.triangles.size(), 6u);
    EXPECT_NEAR(mesh_mass_properties(mesh).volume, 1.0 / 3.0, 1e-7);
    for (std::size_t cut = 1; cut < 40; cut += 13) {
      expect_refused(write("cut.ply", bytes.substr(0, bytes.size() - cut)), ErrorKind::io, "ends early");
    }
  }
}

TEST_F(MeshFile, scales_millimetres_to_metres) {
  expect_brick(read_mesh_file(write("brick.stl", as_text_stl()), 1e-3), 1e-3);
}

TEST_F(MeshFile, refuses_what_is_no_mesh_with_a_sentence_that_names_the_file) {
  expect_refused(folder_ / "absent.stl", ErrorKind::io, "does not exist");
  expect_refused(folder_ / "absent.step", ErrorKind::usage, ".stl, .obj and .ply");
  expect_refused(write("empty.obj", ""), ErrorKind::io, "is empty");
  for (const char* name : {"garbage.stl", "garbage.obj", "garbage.ply"}) {
    expect_refused(write(name, "this is not a mesh\nat all\n"), ErrorKind::io, "export");
  }
  expect_refused(write("points.obj", corners("v ")), ErrorKind::io, "export");
  expect_refused(write("cut.stl", as_binary_stl().substr(0, 300)), ErrorKind::io, "export");
  EXPECT_THROW((void)read_mesh_file(write("brick.stl", as_text_stl()), 0.0), Error);
  EXPECT_THROW((void)read_mesh_file(write("brick.stl", as_text_stl()), -1.0), Error);
}

}  // namespace
}  // namespace scree
