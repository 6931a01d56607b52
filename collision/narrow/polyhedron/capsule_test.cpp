// Capsules against each other and in special poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "polyhedron.hpp"
#include "support/trials.hpp"
#include "testing_solids.hpp"

namespace scree {
namespace {

using namespace test;

double least_gap(const ContactBuffer& contacts) {
  double gap = 1e300;
  for (const Contact& c : contacts) gap = std::min(gap, c.gap);
  return gap;
}

/// Distance of two segments by search: that of a point from a segment is convex along the other segment.
double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto to_second = [&](double s) {
    const Vec3 p = a + s * (b - a);
    const double t = std::clamp(dot(p - c, d - c) / squared_norm(d - c), 0.0, 1.0);
    return norm(p - c - t * (d - c));
  };
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 120; ++k) {
    const double one = low + (high - low) / 3.0, two = high - (high - low) / 3.0;
    (to_second(one) < to_second(two) ? high : low) = to_second(one) < to_second(two) ? two : one;
  }
  return to_second(0.5 * (low + high));
}

// Law: the gap of two capsules is the distance of their axes less both radii.
TEST(Capsules, gap_is_the_distance_of_the_axes) {
  RandomNumbers random{1};
  for (int trial = 0; trial < trials(500); ++trial) {
    const double scale = random.decades(1e-4, 10.0);
    const Solid a = capsule_solid(0.2 * scale, 0.6 * scale), b = capsule_solid(0.3 * scale, 0.2 * scale);
    const Pose pose_a = random.pose(scale), pose_b = random.pose(scale);
    const auto p = a.placed(pose_a), q = b.placed(pose_b);
    const double expected = segment_distance(p[0], p[1], q[0], q[1]) - 0.5 * scale;
    PairScene scene{a.data, b.data};
    Polyhedron phase;
    const ContactBuffer contacts = scene.collide(phase, pose_a, pose_b, 10.0 * scale);
    ASSERT_FALSE(contacts.empty());
    // The search of a minimum knows it to the root of rounding.
    EXPECT_NEAR(least_gap(contacts), expected, 1e-7 * scale);
    const Vec3 n = contacts[0].normal;
    const double along = std::min(dot(n, q[0]), dot(n, q[1])) - std::max(dot(n, p[0]), dot(n, p[1]));
    EXPECT_NEAR(along, expected + 0.5 * scale, 1e-7 * scale) << "the normal separates the axes as far as any";
  }
}

// Law: parallel capsules side by side touch at both ends of what they share, also slightly turned; end to end only once.
TEST(Capsules, parallel_ones_touch_in_two_points) {
  const Solid a = capsule_solid(0.1, 0.5), b = capsule_solid(0.1, 0.3);
  PairScene scene{a.data, b.data};
  Polyhedron phase;
  for (const double turn : {0.0, 1e-9, 1e-4}) {
    for (const double flip : {0.0, std::numbers::pi}) {
      const Quat q = from_rotation_vector({turn, 0, 0}) * from_rotation_vector({0, flip, 0});
      const ContactBuffer two = scene.collide(phase, {}, {{0.199, 0, 0.4}, q}, 0.01);
      ASSERT_EQ(two.size(), 2u);
      double low = std::min(two[0].point.z, two[1].point.z), high = std::max(two[0].point.z, two[1].point.z);
      EXPECT_NEAR(low, 0.1, 1e-4);
      EXPECT_NEAR(high, 0.5, 1e-4);
      for (const Contact& c : two) {
        EXPECT_NEAR(c.gap, -0.001, 1e-7);
        EXPECT_LT(norm(c.normal - Vec3{1, 0, 0}), 1e-3);
        EXPECT_NEAR(c.point.x, 0.0995, 1e-4);
      }
    }
  }
  EXPECT_EQ(scene.collide(phase, {}, {{0, 0, 0.999}, {}}, 0.0).size(), 1u) << "end to end";
  EXPECT_EQ(scene.collide(phase, {}, {{0.15, 0, 0.85}, {}}, 0.0).size(), 1u) << "nothing shared side by side";
}

// Law: axes that cross, and axes on one line, still have a unit normal and the depth of both radii.
TEST(Capsules, crossing_axes_have_a_normal_across_both) {
  const Solid a = capsule_solid(0.1, 0.5), b = capsule_solid(0.2, 0.5);
  PairScene scene{a.data, b.data};
  Polyhedron phase;
  const std::vector<Pose> poses{{}, {{0, 0, 0.3}, from_rotation_vector({0.7, 0, 0})}, {{0, 0, 0.2}, {}}};
  for (const Pose& pose : poses) {
    const ContactBuffer contacts = scene.collide(phase, {}, pose, 0.0);
    ASSERT_FALSE(contacts.empty());
    EXPECT_NEAR(least_gap(contacts), -0.3, 1e-15);
    EXPECT_NEAR(norm(contacts[0].normal), 1.0, 1e-14);
    EXPECT_NEAR(contacts[0].normal.z, 0.0, 1e-14);
    EXPECT_NEAR(dot(contacts[0].normal, rotate(pose.orientation, {0, 0, 1})), 0.0, 1e-14);
  }
}

// Law: a capsule that lies on a box rests on two points, where its axis leaves the box or ends; standing, on one.
TEST(Capsules, lying_on_a_box_has_two_points) {
  const Solid box = box_solid({0.5, 0.5, 0.5}), rod = capsule_solid(0.1, 0.4);
  PairScene scene{box.data, rod.data};
  Polyhedron phase;
  const Quat lying = from_rotation_vector({0, 0.5 * std::numbers::pi, 0});
  ContactBuffer two = scene.collide(phase, {}, {{0.3, 0.1, 0.6 - 1e-3}, lying}, 1e-3);
  ASSERT_EQ(two.size(), 2u);
  std::sort(two.begin(), two.end(), [](const Contact& l, const Contact& r) { return l.point.x < r.point.x; });
  EXPECT_LT(norm(two[0].point - Vec3{-0.1, 0.1, 0.4995}), 1e-12);
  EXPECT_LT(norm(two[1].point - Vec3{0.5, 0.1, 0.4995}), 1e-5) << "at the rim of the box";
  for (const Contact& c : two) {
    EXPECT_NEAR(c.gap, -1e-3, 1e-14);
    EXPECT_LT(norm(c.normal - Vec3{0, 0, 1}), 1e-14);
  }
  EXPECT_EQ(scene.collide(phase, {}, {{0.3, 0.1, 0.999}, {}}, 1e-3).size(), 1u);
}

}  // namespace
}  // namespace scree
