#include "scree/geometry/sphere_decomposition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "scree/base/error.hpp"
#include "scree/geometry/decomposition_cache.hpp"
#include "scree/geometry/solid_deviation.hpp"
#include "scree/geometry/testing_random.hpp"

namespace scree {
namespace {

using testing_random::Random;

/// What grains need: volume within 5 % and Hausdorff distance within 10 % of the size. The volume is held far closer.
void expect_good(const SphereDecomposition& d, const std::string& name) {
  EXPECT_LE(d.spheres.size(), 32u) << name;
  EXPECT_LE(std::abs(d.volume_error), 0.005) << name;
  EXPECT_LE(d.hausdorff, 0.10) << name;
}

ConvexHull random_hull(Random& random, int corners) {
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) points.push_back(random.in_box({-1, -1, -1}, {1, 1, 1}));
  return convex_hull(points);
}

double depth_in(const std::vector<Sphere>& spheres, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Sphere& s : spheres) least = std::min(least, norm(p - s.centre) - s.radius);
  return least;
}

TEST(sphere_decomposition, boxes_are_met_with_32_balls) {
  expect_good(decompose_box({1, 1, 1}), "cube");
  expect_good(decompose_box({1, 1, 2}), "1:1:2");
  expect_good(decompose_box({1, 2, 3}), "1:2:3");
  expect_good(decompose_box({1, 4, 4}), "1:4:4");
  expect_good(decompose_box({1, 1, 10}), "1:1:10");
}

TEST(sphere_decomposition, cylinders_are_met_with_32_balls) {
  for (const double aspect : {0.1, 0.5, 1.0, 2.0, 10.0}) {
    expect_good(decompose_cylinder(1.0, aspect), "length / diameter " + std::to_string(aspect));
  }
}

TEST(sphere_decomposition, random_hulls_are_met_with_32_balls) {
  Random random{41};
  for (int corners = 12; corners <= 20; ++corners) {
    expect_good(decompose_hull(random_hull(random, corners)), "hull of " + std::to_string(corners));
  }
}

// The volume by Monte Carlo: n points in the box around give a standard deviation of sqrt(p (1 - p) / n).
TEST(sphere_decomposition, the_volume_is_what_it_says) {
  Random random{42};
  const SphereDecomposition d = decompose_box({0.5, 1.0, 1.5});
  constexpr int n = 300000;
  int inside = 0;
  for (int i = 0; i < n; ++i) inside += depth_in(d.spheres, random.in_box({-1, -1.5, -2}, {1, 1.5, 2})) < 0.0 ? 1 : 0;
  const double share = static_cast<double>(inside) / n, box = 2.0 * 3.0 * 4.0;
  const double deviation = box * std::sqrt(share * (1.0 - share) / n);
  EXPECT_NEAR(6.0 * (1.0 + d.volume_error), box * share, 4.5 * deviation);
}

// Random points that the measure did not use: of the cube's surface that lie outside the union, and of the union's
// surface. Samples miss extremes by less than 1 % of the size.
TEST(sphere_decomposition, no_random_point_is_further_than_the_stated_distance) {
  Random random{43};
  const Vec3 half{0.5, 0.5, 0.5};
  const SphereDecomposition d = decompose_box(half);
  const Solid cube = box_solid(half);
  const double bound = (d.hausdorff + 0.01) * cube.size;
  double furthest = 0.0;
  for (int i = 0; i < 30000; ++i) {
    Vec3 p = random.in_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    p[i % 3] = i % 2 == 0 ? 0.5 : -0.5;
    furthest = std::max(furthest, depth_in(d.spheres, p));
    const Sphere& s = d.spheres[static_cast<std::size_t>(i) % d.spheres.size()];
    const Vec3 q = s.centre + s.radius * random.direction();
    if (depth_in(d.spheres, q) > -1e-12) furthest = std::max(furthest, std::abs(cube.signed_distance(q)));
  }
  EXPECT_LE(furthest, bound);
  EXPECT_GE(furthest, 0.5 * d.hausdorff * cube.size);  // the stated distance is no idle bound
}

TEST(sphere_decomposition, is_deterministic_to_the_bit) {
  const SphereDecomposition a = decompose_cylinder(1.0, 0.7);
  DecompositionCache::of_program().forget();
  const SphereDecomposition b = decompose_cylinder(1.0, 0.7);
  EXPECT_EQ(a.spheres, b.spheres);
  EXPECT_EQ(a.hausdorff, b.hausdorff);
}

// Similar solids become the same unit solid (boxes and cylinders to the bit), so only the rounding of the scaling is
// left; hulls keep the rounding of their planes.
TEST(sphere_decomposition, scales_with_the_solid) {
  Random random{44};
  const ConvexHull hull = random_hull(random, 14);
  for (const double scale : {1e-3, 0.7, 123.0}) {
    const auto expect_same = [&](const SphereDecomposition& one, const SphereDecomposition& other) {
      ASSERT_EQ(one.spheres.size(), other.spheres.size());
      for (std::size_t i = 0; i < one.spheres.size(); ++i) {
        EXPECT_NEAR(norm(scale * one.spheres[i].centre - other.spheres[i].centre), 0.0, 1e-9 * scale);
        EXPECT_NEAR(scale * one.spheres[i].radius, other.spheres[i].radius, 1e-9 * scale);
      }
      EXPECT_NEAR(one.hausdorff, other.hausdorff, 1e-9);
    };
    expect_same(decompose_box({1, 2, 3}), decompose_box(scale * Vec3{1, 2, 3}));
    expect_same(decompose_cylinder(1.0, 0.8), decompose_cylinder(scale, 0.8 * scale));
    expect_same(decompose_hull(hull), decompose_hull(scaled(hull, scale)));
    expect_same(decompose_box({1, 2, 3}), scaled(decompose_box({1, 2, 3}), scale));
  }
}

TEST(sphere_decomposition, follows_a_solid_that_lies_away_from_the_origin) {
  Random random{45};
  std::vector<Vec3> points;
  for (int i = 0; i < 14; ++i) points.push_back(Vec3{10, -20, 5} + random.in_box({-1, -1, -1}, {1, 1, 1}));
  const ConvexHull hull = convex_hull(points);
  const SphereDecomposition d = decompose_hull(hull);
  expect_good(d, "moved hull");
  EXPECT_NEAR(measure_deviation(hull_solid(hull), d.spheres).hausdorff() / hull_solid(hull).size, d.hausdorff, 1e-6);
}

// The L is not convex: balls that bridge its corner would stick out further than the distance allows.
TEST(sphere_decomposition, works_for_a_mesh_that_is_not_convex) {
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
  expect_good(decompose_mesh(mesh), "L");
}

TEST(sphere_decomposition, fewer_balls_do_when_they_are_enough) {
  const SphereDecomposition few = decompose_cylinder(1.0, 1.0, {.enough_hausdorff = 0.15});
  EXPECT_LT(few.spheres.size(), 32u);
  EXPECT_LE(few.hausdorff_of_equivalent, 0.15);
  EXPECT_EQ(decompose_box({1, 1, 1}, {.max_spheres = 7}).spheres.size(), 7u);
}

// One ball cannot be a rod: the errors say so, and the caller refuses.
TEST(sphere_decomposition, reports_truthfully_what_cannot_be_met) {
  const SphereDecomposition rod = decompose_box({1, 1, 10}, {.max_spheres = 1});
  EXPECT_GT(rod.hausdorff,
            0.3);  // the ends stand 10 - 1.24 * 10^(1/3) from the ball of equal volume, of a size of 20.2
}

TEST(sphere_decomposition, copes_with_a_thin_slanting_flake) {
  Random random{46};
  const Quat rotation = random.rotation();
  std::vector<Vec3> points;
  for (int i = 0; i < 14; ++i) points.push_back(rotate(rotation, random.in_box({-1, -1, -0.005}, {1, 1, 0.005})));
  const SphereDecomposition flake = decompose_hull(convex_hull(points));
  EXPECT_EQ(flake.spheres.size(), 32u);
  EXPECT_TRUE(std::ranges::all_of(flake.spheres, [](const Sphere& s) { return s.radius > 0 && is_finite(s.centre); }));
}

TEST(sphere_decomposition, refuses_lengths_and_counts_out_of_range) {
  EXPECT_THROW((void)decompose_box({1, 0, 1}), Error);
  EXPECT_THROW((void)decompose_box({1, std::numeric_limits<double>::quiet_NaN(), 1}), Error);
  EXPECT_THROW((void)decompose_cylinder(-1.0, 1.0), Error);
  EXPECT_THROW((void)decompose_box({1, 1, 1}, {.max_spheres = 0}), Error);
}

}  // namespace
}  // namespace scree
