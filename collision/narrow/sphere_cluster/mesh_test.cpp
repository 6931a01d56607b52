// Spheres against triangle meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "mesh_tree.hpp"
#include "scree/geometry/triangle_mesh_data.hpp"
#include "support/random_numbers.hpp"
#include "support/trials.hpp"

namespace scree::sphere_cluster {
namespace {

using test::RandomNumbers;
using test::trials;

/// Distance of p from a triangle, by another way than the code under test: the foot on the plane when it lies inside
/// by areas, else the nearest of three segments.
double reference_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 n = normalized(cross(b - a, c - a));
  const Vec3 foot = p - dot(n, p - a) * n;
  const auto inside = [&](const Vec3& from, const Vec3& to) { return dot(cross(to - from, foot - from), n) >= 0.0; };
  if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(dot(n, p - a));
  const auto segment = [&](const Vec3& from, const Vec3& to) {
    const double t = std::clamp(dot(p - from, to - from) / squared_norm(to - from), 0.0, 1.0);
    return norm(p - from - t * (to - from));
  };
  return std::min({segment(a, b), segment(b, c), segment(c, a)});
}

/// A square sheet of 2 n^2 triangles in the plane z = height(x, y), |x|, |y| <= 1.
template <class Height>
TriangleMesh sheet(int n, const Height& height) {
  TriangleMesh mesh;
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = -1.0 + 2.0 * i / n, y = -1.0 + 2.0 * j / n;
      mesh.vertices.push_back({x, y, height(x, y)});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// Law: the nearest touch is at the least distance of all triangles; there is one whenever a triangle is within reach.
TEST(MeshTree, nearest_touch_is_the_nearest_triangle) {
  RandomNumbers random{1};
  for (int trial = 0; trial < trials(300); ++trial) {
    const double scale = random.decades(1e-4, 10.0);
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t k = 0; k < 60; k += 3) {
      const Vec3 at = random.in_cube(scale);
      for (int corner = 0; corner < 3; ++corner) vertices.push_back(at + random.in_cube(0.4 * scale));
      triangles.push_back({k, k + 1, k + 2});
    }
    const MeshTree tree{vertices, triangles};
    EXPECT_FALSE(tree.closed());
    const Vec3 p = random.in_cube(1.5 * scale);
    const double r = random.uniform(0.05, 0.5) * scale;
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles) {
      least = std::min(least, reference_distance(vertices[t[0]], vertices[t[1]], vertices[t[2]], p));
    }
    MeshScratch scratch;
    tree.touch(p, r, 0.1 * scale, scratch);
    ASSERT_EQ(scratch.touches.empty(), least >= r + 0.1 * scale);
    if (scratch.touches.empty()) continue;
    EXPECT_NEAR(scratch.touches[0].nearest.distance, least, 1e-12 * scale);
  }
}

// Law: a flat sheet of triangles is one plane, also where a sphere stands over an edge or a corner.
TEST(MeshTree, flat_sheet_is_touched_once) {
  RandomNumbers random{2};
  const TriangleMesh mesh = sheet(8, [](double, double) { return 0.0; });
  const MeshTree tree{mesh.vertices, mesh.triangles};
  MeshScratch scratch;
  for (int trial = 0; trial < trials(2000); ++trial) {
    Vec3 p = random.in_cube(0.99);
    // On grid lines, on diagonals, on corners, and anywhere.
    if (trial % 4 == 1) p.x = 0.25 * std::round(4.0 * p.x);
    if (trial % 4 == 2) p.y = p.x;
    if (trial % 4 == 3) p = {0.25 * std::round(3.0 * p.x), 0.25 * std::round(3.0 * p.y), p.z};
    p.z = random.uniform(0.01, 0.29);
    tree.touch(p, 0.3, 0.0, scratch);
    ASSERT_EQ(scratch.touches.size(), 1u) << p.x << " " << p.y << " " << p.z;
    EXPECT_NEAR(scratch.touches[0].nearest.distance, p.z, 1e-15);
    EXPECT_LT(norm(scratch.touches[0].nearest.normal - Vec3{0, 0, 1}), 1e-12);
    tree.touch({p.x, p.y, -p.z}, 0.3, 0.0, scratch);
    ASSERT_EQ(scratch.touches.size(), 1u) << "a sheet has two sides";
    EXPECT_LT(norm(scratch.touches[0].nearest.normal - Vec3{0, 0, -1}), 1e-12);
  }
}

// Law: on a convex roof a sphere touches once, in a valley twice.
TEST(MeshTree, roof_is_touched_once_and_valley_twice) {
  RandomNumbers random{3};
  MeshScratch scratch;
  const TriangleMesh roof = sheet(6, [](double x, double) { return -0.5 * std::abs(x); });
  const TriangleMesh valley = sheet(6, [](double x, double) { return 0.5 * std::abs(x); });
  const MeshTree on_roof{roof.vertices, roof.triangles};
  const MeshTree in_valley{valley.vertices, valley.triangles};
  for (int trial = 0; trial < trials(300); ++trial) {
    const double x = random.uniform(-0.05, 0.05);
    const double y = trial % 3 == 0 ? 0.0 : random.uniform(-0.5, 0.5);
    on_roof.touch({x, y, 0.2}, 0.3, 0.0, scratch);
    EXPECT_EQ(scratch.touches.size(), 1u);
    in_valley.touch({x, y, 0.3}, 0.4, 0.0, scratch);
    ASSERT_EQ(scratch.touches.size(), 2u);
    // Distance from the two planes z = +-x/2.
    std::array<double, 2> distance{scratch.touches[0].nearest.distance, scratch.touches[1].nearest.distance};
    std::sort(distance.begin(), distance.end());
    EXPECT_NEAR(distance[0], (0.3 - 0.5 * std::abs(x)) / std::hypot(1.0, 0.5), 1e-14);
    EXPECT_NEAR(distance[1], (0.3 + 0.5 * std::abs(x)) / std::hypot(1.0, 0.5), 1e-14);
  }
}

// Law: a box as a mesh and a box in closed form are the same solid, outside, at edges and corners, and inside.
TEST(MeshTree, box_mesh_is_a_box) {
  RandomNumbers random{4};
  const Vec3 half{0.7, 0.5, 0.3};
  const TriangleMesh mesh = box_mesh(half);
  const MeshTree tree{mesh.vertices, mesh.triangles};
  EXPECT_TRUE(tree.closed());
  MeshScratch scratch;
  int inside = 0;
  for (int trial = 0; trial < trials(2000); ++trial) {
    const Vec3 p = random.in_cube(1.0);
    const Nearest expected = nearest_on_box(half, p);
    const double r = 0.35;
    tree.touch(p, r, 0.05, scratch);
    ASSERT_EQ(scratch.touches.size(), expected.distance < r + 0.05 ? 1u : 0u);
    if (scratch.touches.empty()) continue;
    inside += expected.distance < 0.0;
    EXPECT_NEAR(scratch.touches[0].nearest.distance, expected.distance, 1e-14);
    EXPECT_LT(norm(scratch.touches[0].nearest.normal - expected.normal), 1e-9);
  }
  EXPECT_GT(inside, 100);
}

// Law: vertices at the same place are one vertex: a mesh from a file that repeats them is as closed, and gives the same
// touches, as the welded one.
TEST(MeshTree, repeated_vertices_change_nothing) {
  RandomNumbers random{5};
  const TriangleMesh mesh = cylinder_mesh(0.5, 0.5, 12);
  std::vector<Vec3> loose;
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(loose.size());
    for (const std::uint32_t v : t) loose.push_back(mesh.vertices[v]);
    triangles.push_back({first, first + 1, first + 2});
  }
  const MeshTree one{mesh.vertices, mesh.triangles};
  const MeshTree other{loose, triangles};
  EXPECT_TRUE(one.closed() && other.closed());
  MeshScratch a, b;
  for (int trial = 0; trial < trials(500); ++trial) {
    const Vec3 p = random.in_cube(0.8);
    one.touch(p, 0.2, 0.05, a);
    other.touch(p, 0.2, 0.05, b);
    ASSERT_EQ(a.touches.size(), b.touches.size());
    for (std::size_t k = 0; k < a.touches.size(); ++k) {
      EXPECT_EQ(a.touches[k].feature, b.touches[k].feature);
      EXPECT_EQ(a.touches[k].nearest.distance, b.touches[k].nearest.distance);
    }
  }
}

}  // namespace
}  // namespace scree::sphere_cluster
