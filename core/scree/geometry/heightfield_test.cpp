#include "scree/geometry/heightfield.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "scree/base/error.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/mesh_examination.hpp"

namespace scree {
namespace {

/// Heights of the plane z = 0.1 + x / 2 - y / 4 over a grid of 5 by 4 points.
HeightGrid slope() {
  HeightGrid grid{5, 4, 0.01, 0.02, {}};
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 5; ++i) grid.heights.push_back(0.1 + 0.5 * 0.01 * i - 0.25 * 0.02 * k);
  }
  return grid;
}

void expect_refused(const HeightGrid& grid, std::optional<double> base, const std::string& words) {
  try {
    (void)heightfield_mesh(grid, base);
    ADD_FAILURE() << "accepted; expected: " << words;
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find(words), std::string::npos) << error.what();
  }
}

TEST(heightfield_mesh, heights_in_a_plane_give_triangles_of_that_plane_seen_from_above) {
  const TriangleMesh mesh = heightfield_mesh(slope());
  EXPECT_EQ(mesh.triangles.size(), 2u * 4u * 3u);
  const Vec3 normal = normalized(Vec3{-0.5, 0.25, 1.0});  // of z - x / 2 + y / 4 = 0.1
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 across = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    EXPECT_NEAR(norm(normalized(across) - normal), 0.0, 1e-13);  // rounding of differences of lengths 0.01 m
    area += 0.5 * across.z;                                      // of its shadow
  }
  EXPECT_NEAR(area, 0.04 * 0.06, 1e-15);
  EXPECT_EQ(examine_mesh(mesh).crossings, 0u);
}

TEST(heightfield_mesh, a_base_makes_it_a_solid_of_the_volume_below_the_surface) {
  const TriangleMesh mesh = heightfield_mesh(slope(), -0.05);
  EXPECT_EQ(examine_mesh(mesh).problem(), "");
  // Over a plane: mean height times area. The mean is the height at the middle, 0.1 + 0.5 * 0.02 - 0.25 * 0.03 m.
  EXPECT_NEAR(mesh_mass_properties(mesh).volume, 0.04 * 0.06 * (0.1025 + 0.05), 1e-15);
}

TEST(heightfield_mesh, says_what_is_wrong_with_sizes) {
  HeightGrid grid = slope();
  grid.heights.pop_back();
  expect_refused(grid, {}, "5 columns and 4 rows needs 20 heights, but has 19");
  expect_refused({1, 4, 0.01, 0.01, {1, 2, 3, 4}}, {}, "at least 2 columns and 2 rows");
  expect_refused({0, 0, 0.01, 0.01, {}}, {}, "at least 2 columns and 2 rows");
  expect_refused({2, 2, 0.0, 0.01, {1, 2, 3, 4}}, {}, "spacing");
  expect_refused(slope(), 0.2, "below all of its heights");
  grid = slope();
  grid.heights[3] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(grid, {}, "finite");
}

class HeightFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  HeightGrid read(const std::string& text, double scale = 1.0) {
    std::ofstream{file_} << text;
    return read_height_file(file_, scale);
  }
  std::string refusal(const std::string& text) {
    try {
      (void)read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  }
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("scree_heights_" + std::to_string(::getpid()) + ".txt");
};

TEST_F(HeightFile, has_a_row_a_line) {
  const HeightGrid grid = read("# mm\n1 2 3\n\n4, 5, 6\n", 1e-3);
  EXPECT_EQ(grid.columns, 3u);
  EXPECT_EQ(grid.rows, 2u);
  EXPECT_DOUBLE_EQ(grid.heights[5], 6e-3);
}

TEST_F(HeightFile, is_refused_with_its_line) {
  EXPECT_NE(refusal("1 2\n3 x\n").find(":2: 'x' is no number"), std::string::npos) << refusal("1 2\n3 x\n");
  EXPECT_NE(refusal("1 2\n\n3\n").find(":3: this row has 1 heights, but the first row has 2"), std::string::npos);
  EXPECT_NE(refusal("1 nan\n").find(":1: a height is not finite"), std::string::npos);
  EXPECT_THROW((void)read_height_file("/no/such/file.txt"), Error);
  EXPECT_THROW((void)read_height_file("/"), Error);
}

}  // namespace
}  // namespace scree
