#include "scree/geometry/triangle_mesh_data.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace scree {
namespace {

TEST(check_mesh, a_box_is_a_solid_of_euler_number_two) {
  const MeshReport report = check_mesh(box_mesh({1, 2, 3}));
  EXPECT_TRUE(report.is_solid()) << report.problem();
  EXPECT_EQ(report.euler, 2);
  EXPECT_DOUBLE_EQ(report.volume, 48.0);
}

TEST(check_mesh, a_cylinder_is_a_solid) {
  const MeshReport report = check_mesh(cylinder_mesh(1e-3, 2e-3, 24));
  EXPECT_TRUE(report.is_solid()) << report.problem();
  EXPECT_EQ(report.euler, 2);
}

TEST(check_mesh, finds_a_hole) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  mesh.triangles.pop_back();
  const MeshReport report = check_mesh(mesh);
  EXPECT_EQ(report.open_edges, 3u);
  EXPECT_FALSE(report.is_closed());
  EXPECT_NE(report.problem().find("holes"), std::string::npos) << report.problem();
}

TEST(check_mesh, finds_one_turned_triangle) {
  TriangleMesh mesh = box_mesh({1, 1, 1});
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.misoriented_edges, 3u);  // each side of the turned triangle
  EXPECT_FALSE(report.is_solid());
}

TEST(check_mesh, finds_a_surface_that_is_inside_out) {
  const TriangleMesh mesh = turned_inside_out(box_mesh({1, 1, 1}));
  EXPECT_TRUE(check_mesh(mesh).inside_out);
  EXPECT_FALSE(check_mesh(mesh).is_solid());
  EXPECT_TRUE(check_mesh(turned_inside_out(mesh)).is_solid());
}

TEST(check_mesh, finds_degenerate_triangles_bad_indices_and_nan) {
  TriangleMesh flat = box_mesh({1, 1, 1});
  flat.triangles.push_back({0, 1, 1});
  EXPECT_EQ(check_mesh(flat).degenerate_triangles, 1u);
  TriangleMesh wild = box_mesh({1, 1, 1});
  wild.triangles.push_back({0, 1, 99});
  EXPECT_EQ(check_mesh(wild).bad_indices, 1u);
  TriangleMesh nan = box_mesh({1, 1, 1});
  nan.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_mesh(nan).bad_vertices, 1u);
  EXPECT_FALSE(check_mesh(nan).is_solid());
  EXPECT_FALSE(check_mesh({}).is_solid());
}

TEST(check_mesh, a_torus_has_euler_number_zero) {
  TriangleMesh torus;
  constexpr std::uint32_t n = 8;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = 0.25 * M_PI * i, v = 0.25 * M_PI * j;
      torus.vertices.push_back({(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * n + j, b = ((i + 1) % n) * n + j;
      const std::uint32_t c = ((i + 1) % n) * n + (j + 1) % n, d = i * n + (j + 1) % n;
      torus.triangles.push_back({a, b, c});
      torus.triangles.push_back({a, c, d});
    }
  }
  EXPECT_TRUE(check_mesh(torus).is_solid()) << check_mesh(torus).problem();
  EXPECT_EQ(check_mesh(torus).euler, 0);
}

TEST(welded, joins_the_corners_of_a_triangle_soup) {
  const TriangleMesh box = box_mesh({1, 2, 3});
  TriangleMesh soup;
  for (const Triangle& t : box.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(box.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_FALSE(check_mesh(soup).is_closed());
  const TriangleMesh joined = welded(soup, 1e-9);
  EXPECT_EQ(joined.vertices.size(), 8u);
  EXPECT_TRUE(check_mesh(joined).is_solid());
  EXPECT_DOUBLE_EQ(check_mesh(joined).volume, 48.0);
}

}  // namespace
}  // namespace scree
