// Spheres far below the surface of closed meshes, where no triangle is near.
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

/// A corridor's corner seen from above, 0.6 high: the square |x|, |y| <= 1 without its quarter x, y > 0.
TriangleMesh corner_piece() {
  const std::vector<std::array<double, 2>> outline{{0, 0}, {0, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}};
  TriangleMesh mesh;
  for (const double z : {-0.3, 0.3}) {
    for (const auto& [x, y] : outline) mesh.vertices.push_back({x, y, z});
  }
  // All of it is seen from the inner corner.
  for (std::uint32_t k = 1; k + 1 < 6; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    mesh.triangles.push_back({6, 6 + k, 6 + k + 1});
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, 6 + next});
    mesh.triangles.push_back({k, 6 + next, 6 + k});
  }
  return mesh;
}

bool in_corner_piece(const Vec3& p) {
  return std::max(std::abs(p.x), std::abs(p.y)) < 1.0 && std::abs(p.z) < 0.3 && !(p.x >= 0.0 && p.y >= 0.0);
}

/// The way to the surface from within: to one of its planes, or to the edge of the inner corner.
double depth_in_corner_piece(const Vec3& p) {
  const double inner = std::hypot(std::min(p.x, 0.0), std::min(p.y, 0.0));
  return std::min({1.0 + p.x, 1.0 + p.y, 1.0 - p.x, 1.0 - p.y, 0.3 - std::abs(p.z), inner});
}

/// Points anywhere, and such that stand exactly above or below corners, edges and diagonals of triangles.
Vec3 point(RandomNumbers& random, int trial) {
  Vec3 p = random.in_cube(1.2);
  const auto onto = [](double x, double step) { return step * std::round(x / step); };
  if (trial % 5 == 1) p.x = onto(p.x, 0.5);
  if (trial % 5 == 2) p.y = onto(p.y, 0.5);
  if (trial % 5 == 3) p = {onto(p.x, 0.5), onto(p.y, 0.5), p.z};
  if (trial % 5 == 4) p.y = p.x;
  p.z *= 0.4;
  return p;
}

// Law: a grain of any size within a closed solid is led out through the nearest surface; outside and in a notch it touches nothing.
TEST(DeepInMesh, grains_are_led_out_of_a_solid_with_a_notch) {
  const TriangleMesh mesh = corner_piece();
  const MeshTree tree{mesh.vertices, mesh.triangles};
  ASSERT_TRUE(tree.closed());
  RandomNumbers random{51};
  MeshScratch scratch;
  int deep = 0, free = 0;
  for (int trial = 0; trial < trials(6000); ++trial) {
    const Vec3 p = point(random, trial);
    const double r = random.decades(1e-4, 1e-2);
    tree.touch(p, r, 0.0, scratch);
    if (!in_corner_piece(p)) {
      // Those at the surface are the matter of other tests.
      if (scratch.touches.empty()) ++free;
      for (const MeshTouch& touch : scratch.touches) EXPECT_LT(std::abs(touch.nearest.distance), r);
      continue;
    }
    const double depth = depth_in_corner_piece(p);
    if (depth < 1e-9) continue;
    ASSERT_EQ(scratch.touches.size(), 1u) << p.x << " " << p.y << " " << p.z << " r " << r;
    const Nearest& nearest = scratch.touches[0].nearest;
    EXPECT_NEAR(nearest.distance, -depth, 1e-14);
    EXPECT_NEAR(norm(nearest.normal), 1.0, 1e-14);
    // The way out ends on the surface: the point a little further is free, one a little before it is not.
    EXPECT_FALSE(in_corner_piece(p + (depth + 1e-9) * nearest.normal));
    EXPECT_TRUE(in_corner_piece(p + (depth - 1e-9) * nearest.normal));
    deep += depth > 2.0 * r;
  }
  EXPECT_GT(deep, 1000);
  EXPECT_GT(free, 1000);
}

// Law: the mesh of a box is a box however small the grain.
TEST(DeepInMesh, box_mesh_is_a_box_to_its_middle) {
  RandomNumbers random{52};
  const Vec3 half{0.7, 0.5, 0.3};
  const TriangleMesh mesh = box_mesh(half);
  const MeshTree tree{mesh.vertices, mesh.triangles};
  MeshScratch scratch;
  for (int trial = 0; trial < trials(2000); ++trial) {
    const Vec3 p{half.x * random.uniform(-1, 1), half.y * random.uniform(-1, 1), half.z * random.uniform(-1, 1)};
    const Nearest expected = nearest_on_box(half, p);
    tree.touch(p, 1e-3, 0.0, scratch);
    ASSERT_EQ(scratch.touches.size(), 1u);
    EXPECT_NEAR(scratch.touches[0].nearest.distance, expected.distance, 1e-14);
    EXPECT_LT(norm(scratch.touches[0].nearest.normal - expected.normal), 1e-9);
  }
  tree.touch({}, 1e-3, 0.0, scratch);
  ASSERT_EQ(scratch.touches.size(), 1u) << "the middle";
  EXPECT_NEAR(scratch.touches[0].nearest.distance, -0.3, 1e-15);
}

// Law: a room between an outer and an inner wall of one mesh is the solid; the cavity is free, and so is a place without
// coordinates.
TEST(DeepInMesh, a_cavity_is_free) {
  TriangleMesh shell = box_mesh({1.0, 1.0, 1.0});
  const TriangleMesh inner = turned_inside_out(box_mesh({0.5, 0.5, 0.5}));
  const auto first = static_cast<std::uint32_t>(shell.vertices.size());
  shell.vertices.insert(shell.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (const Triangle& t : inner.triangles) shell.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  const MeshTree tree{shell.vertices, shell.triangles};
  RandomNumbers random{53};
  MeshScratch scratch;
  for (int trial = 0; trial < trials(1000); ++trial) {
    const double r = 1e-3;
    tree.touch(random.in_cube(0.49), r, 0.0, scratch);
    EXPECT_TRUE(scratch.touches.empty());
    Vec3 p = random.in_cube(0.99);
    p[trial % 3] = 0.75;
    tree.touch(p, r, 0.0, scratch);
    EXPECT_EQ(scratch.touches.size(), 1u);
  }
  tree.touch({0, 0, std::numeric_limits<double>::quiet_NaN()}, 1e-3, 0.0, scratch);
  EXPECT_TRUE(scratch.touches.empty());
}

// Law: a mesh that is inside out is the wall of a room: what is in the room is free.
TEST(DeepInMesh, a_room_is_free) {
  const TriangleMesh mesh = turned_inside_out(box_mesh({1.0, 1.0, 1.0}));
  const MeshTree tree{mesh.vertices, mesh.triangles};
  RandomNumbers random{54};
  MeshScratch scratch;
  for (int trial = 0; trial < trials(1000); ++trial) {
    tree.touch(random.in_cube(0.9), 1e-3, 0.0, scratch);
    EXPECT_TRUE(scratch.touches.empty());
  }
}

}  // namespace
}  // namespace scree::sphere_cluster
