#include "scree/geometry/signed_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "scree/base/error.hpp"
#include "scree/geometry/testing_random.hpp"

namespace scree {
namespace {

using testing_random::Random;

/// Signed distance of a mesh by trying every triangle; the sign from the solid angle (van Oosterom and Strackee), which
/// shares nothing with the pseudonormals of the code under test.
double brute_force(const TriangleMesh& mesh, const Vec3& p) {
  double squared = std::numeric_limits<double>::infinity(), solid_angle = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    squared = std::min(squared, squared_norm(closest_on_triangle({}, a, b, c).point));
    const double la = norm(a), lb = norm(b), lc = norm(c);
    solid_angle +=
        2.0 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return (solid_angle > 2.0 * std::numbers::pi ? -1.0 : 1.0) * std::sqrt(squared);
}

TEST(signed_distance, a_box_agrees_with_its_mesh_and_its_hull) {
  Random random{21};
  const Vec3 half{0.5, 1.0, 1.5};
  const MeshDistance mesh{box_mesh(half)};
  const ConvexHull hull = convex_hull(box_mesh(half).vertices);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.in_box({-3, -3, -3}, {3, 3, 3});
    const double closed = box_signed_distance(half, p);
    EXPECT_NEAR(mesh.signed_distance(p), closed, 1e-12);
    EXPECT_NEAR(hull_signed_distance(hull, p), closed, 1e-12);
    EXPECT_NEAR(brute_force(mesh.mesh(), p), closed, 1e-12);
  }
}

TEST(signed_distance, a_hull_agrees_with_brute_force) {
  Random random{22};
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<Vec3> points;
    for (int i = 0; i < 20; ++i) points.push_back(random.direction());
    const ConvexHull hull = convex_hull(points);
    const MeshDistance mesh{surface_of(hull)};
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = random.in_box({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5});
      const double closed = brute_force(mesh.mesh(), p);
      EXPECT_NEAR(hull_signed_distance(hull, p), closed, 1e-12);
      EXPECT_NEAR(mesh.signed_distance(p), closed, 1e-12);
    }
  }
}

// An L of two boxes: not convex, with an edge where the face normals alone would give the wrong sign.
TEST(signed_distance, a_mesh_that_is_not_convex_agrees_with_brute_force) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0},
                   {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t n = (k + 1) % 6;
    mesh.triangles.push_back({k, n, n + 6});
    mesh.triangles.push_back({k, n + 6, k + 6});
  }
  for (const Triangle& t : {Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 3, 5}, Triangle{3, 4, 5}}) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  const MeshDistance distance{mesh};
  Random random{23};
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = random.in_box({-1, -1, -1}, {3, 3, 2});
    EXPECT_NEAR(distance.signed_distance(p), brute_force(mesh, p), 1e-12);
    EXPECT_NEAR(norm(p - distance.closest(p).point), std::abs(distance.signed_distance(p)), 1e-12);
  }
}

// A prism of n sides lies within r (1 - cos(pi / n)) of the cylinder: 3e-4 for 128 sides.
TEST(signed_distance, a_cylinder_agrees_with_a_fine_prism) {
  const MeshDistance prism{cylinder_mesh(1.0, 0.7, 128)};
  Random random{24};
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.in_box({-2, -2, -2}, {2, 2, 2});
    EXPECT_NEAR(cylinder_signed_distance(1.0, 0.7, p), prism.signed_distance(p), 3.1e-4);
  }
}

// Walking outwards from a point of the surface along the normal, the distance is the way walked; known points of each.
TEST(signed_distance, capsule_and_cone_at_known_points) {
  EXPECT_DOUBLE_EQ(capsule_signed_distance(0.5, 1.0, {0, 0, 2}), 0.5);
  EXPECT_DOUBLE_EQ(capsule_signed_distance(0.5, 1.0, {2, 0, 0.9}), 1.5);
  EXPECT_DOUBLE_EQ(capsule_signed_distance(0.5, 1.0, {0, 0, 0.3}), -0.5);
  EXPECT_DOUBLE_EQ(cone_signed_distance(1.0, 1.0, {0, 0, 2}), 1.0);
  EXPECT_DOUBLE_EQ(cone_signed_distance(1.0, 1.0, {0, 0, -2}), 1.0);
  EXPECT_DOUBLE_EQ(cone_signed_distance(1.0, 1.0, {4, 0, -1}), 3.0);
  const Vec3 slope_normal = normalized(Vec3{2, 0, 1});
  EXPECT_NEAR(cone_signed_distance(1.0, 1.0, Vec3{0.5, 0, 0} + 0.2 * slope_normal), 0.2, 1e-14);
  EXPECT_NEAR(cone_signed_distance(1.0, 1.0, Vec3{0.5, 0, 0} - 0.1 * slope_normal), -0.1, 1e-14);
}

TEST(signed_distance, refuses_an_open_mesh) {
  TriangleMesh open = box_mesh({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_THROW(MeshDistance{open}, Error);
}

}  // namespace
}  // namespace scree
