#include "scree/geometry/shaving.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "scree/base/error.hpp"
#include "scree/geometry/mass_properties.hpp"

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(shaving, straight_is_a_row_along_x_of_the_stated_length) {
  const std::vector<Sphere> row = shaving_spheres({.length = 3e-3, .diameter = 1e-3, .count = 5});
  ASSERT_EQ(row.size(), 5u);
  EXPECT_NEAR(row.front().centre.x - row.front().radius, -1.5e-3, 1e-18);
  EXPECT_NEAR(row.back().centre.x + row.back().radius, 1.5e-3, 1e-18);
  for (std::size_t i = 1; i < row.size(); ++i) EXPECT_NEAR(row[i].centre.x - row[i - 1].centre.x, 0.5e-3, 1e-18);
}

// Without twist the centres lie on a circle of radius l / bend about (0, l / bend, 0).
TEST(shaving, bent_lies_on_an_arc) {
  const double line = 4.0, bend = 2.0, radius = line / bend;
  for (const Sphere& s : shaving_spheres({.length = 5.0, .diameter = 1.0, .bend = bend, .count = 9})) {
    EXPECT_NEAR(norm(s.centre - Vec3{0, radius, 0}), radius, 1e-13);
    EXPECT_NEAR(s.centre.z, 0.0, 1e-15);
  }
}

TEST(shaving, a_full_turn_closes_the_ring) {
  const std::vector<Sphere> ring = shaving_spheres({.length = 13.0, .diameter = 1.0, .bend = 2.0 * kPi, .count = 30});
  EXPECT_NEAR(norm(ring.front().centre - ring.back().centre), 0.0, 1e-13);
}

// A curve of curvature k and torsion t is a helix about the axis w = (t, 0, k): radius k / |w|^2, and it rises by
// t / |w| along the axis per length.
TEST(shaving, twisted_lies_on_a_helix) {
  const double line = 6.0, bend = 3.0, twist = 2.0;
  const double k = bend / line, t = twist / line, w = std::hypot(k, t);
  const Vec3 axis = Vec3{t, 0, k} / w, origin{0, k / (w * w), 0};
  const std::vector<Sphere> spheres =
      shaving_spheres({.length = 7.0, .diameter = 1.0, .bend = bend, .twist = twist, .count = 13});
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const double s = line * (static_cast<double>(i) / 12.0 - 0.5);
    const Vec3 from_axis = spheres[i].centre - origin;
    const double height = dot(from_axis, axis);
    EXPECT_NEAR(height, t / w * s, 1e-13);
    EXPECT_NEAR(norm(from_axis - height * axis), k / (w * w), 1e-13);
  }
}

TEST(shaving, twisting_the_other_way_is_the_mirror_image) {
  const auto left = shaving_spheres({.length = 7.0, .diameter = 1.0, .bend = 3.0, .twist = 2.0, .count = 13});
  const auto right = shaving_spheres({.length = 7.0, .diameter = 1.0, .bend = 3.0, .twist = -2.0, .count = 13});
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_NEAR(left[i].centre.x, right[i].centre.x, 1e-14);
    EXPECT_NEAR(left[i].centre.y, right[i].centre.y, 1e-14);
    EXPECT_NEAR(left[i].centre.z, -right[i].centre.z, 1e-14);
  }
}

// Many balls close together are nearly a capsule; the ripples between balls at spacing a = d / 8 take away a share of
// at most (a / d)^2 / 3 = 0.5 % of the barrel.
TEST(shaving, a_dense_straight_one_weighs_like_a_capsule) {
  const std::vector<Sphere> row = shaving_spheres({.length = 4.0, .diameter = 1.0, .count = 25});
  const MassProperties found = cluster_mass_properties(row), capsule = capsule_mass_properties(0.5, 1.5);
  EXPECT_LT(found.volume, capsule.volume);
  EXPECT_NEAR(found.volume / capsule.volume, 1.0, 6e-3);
  EXPECT_NEAR(found.inertia.y / capsule.inertia.x, 1.0, 6e-3);  // the row runs along x, the capsule along z
  EXPECT_NEAR(found.inertia.x / capsule.inertia.z, 1.0, 1.5e-2);
}

TEST(shaving, chooses_as_many_balls_as_half_a_diameter_needs) {
  EXPECT_EQ(shaving_spheres({.length = 4.0, .diameter = 1.0}).size(), 7u);
  EXPECT_EQ(shaving_spheres({.length = 1.0, .diameter = 1.0}).size(), 1u);
  EXPECT_EQ(shaving_spheres({.length = 30.0, .diameter = 1.0}).size(), 32u);  // spacing 0.94 d: they still meet
}

TEST(shaving, refuses_impossible_ones) {
  EXPECT_THROW((void)shaving_spheres({.length = 1.0, .diameter = 0.0}), Error);
  EXPECT_THROW((void)shaving_spheres({.length = 0.5, .diameter = 1.0}), Error);
  EXPECT_THROW((void)shaving_spheres({.length = 40.0, .diameter = 1.0}), Error);
  EXPECT_THROW((void)shaving_spheres({.length = 4.0, .diameter = 1.0, .count = 3}), Error);
  EXPECT_THROW((void)shaving_spheres({.length = 4.0, .diameter = 1.0, .count = 33}), Error);
  EXPECT_THROW((void)shaving_spheres({.length = 4.0, .diameter = 1.0, .bend = 7.0}), Error);
  EXPECT_THROW((void)shaving_spheres({.length = std::numeric_limits<double>::infinity(), .diameter = 1.0}), Error);
}

}  // namespace
}  // namespace scree
