// Where the points of faces, edges and corners lie, and that they hold still under small changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "polyhedron.hpp"
#include "support/trials.hpp"
#include "testing_solids.hpp"

namespace scree {
namespace {

using namespace test;

constexpr double kQuarter = 0.5 * std::numbers::pi;

std::set<std::uint64_t> features(const ContactBuffer& contacts) {
  std::set<std::uint64_t> out;
  for (const Contact& c : contacts) out.insert(c.feature);
  return out;
}

// Law: of two boxes on each other the corners of the shared rectangle touch, whichever of them is a.
TEST(Manifold, boxes_share_a_rectangle) {
  const Solid lower = box_solid({1.0, 1.0, 0.5}), upper = box_solid({0.4, 0.6, 0.2});
  for (const double gap : {-1e-3, -1e-7, 0.0, 1e-7, 1e-3}) {
    PairScene scene{lower.data, upper.data};
    Polyhedron phase;
    ContactBuffer four = scene.collide(phase, {}, {{0.8, 0.1, 0.7 + gap}, {}}, 0.01);
    ASSERT_EQ(four.size(), 4u) << gap;
    for (const Contact& c : four) {
      // The gap is a difference of lengths about one.
      EXPECT_NEAR(c.gap, gap, 1e-15);
      EXPECT_LT(norm(c.normal - Vec3{0, 0, 1}), 1e-9);
      EXPECT_NEAR(c.point.z, 0.5 + 0.5 * gap, 1e-15);
      // The rectangle reaches from 0.4 to 1.0 and from -0.5 to 0.7.
      EXPECT_LT(std::min(std::abs(c.point.x - 0.4), std::abs(c.point.x - 1.0)), 1e-12);
      EXPECT_LT(std::min(std::abs(c.point.y + 0.5), std::abs(c.point.y - 0.7)), 1e-12);
    }
  }
}

// Law: two squares turned by 45 degrees share an octagon: eight points. Two discs of many sides keep eight of theirs, and the
// polygon of those has most of the area of the disc.
TEST(Manifold, many_corners_are_thinned_out) {
  PairScene squares{box_solid({1, 1, 1}).data, box_solid({1, 1, 1}).data};
  Polyhedron phase;
  const ContactBuffer octagon =
      squares.collide(phase, {}, {{0, 0, 1.999}, from_rotation_vector({0, 0, 0.5 * kQuarter})}, 0.0);
  EXPECT_EQ(octagon.size(), 8u);
  PairScene discs{prism(24, 1.0, 0.1).data, prism(24, 1.0, 0.1).data};
  Polyhedron other;
  const ContactBuffer kept = discs.collide(other, {}, {{0, 0, 0.199}, from_rotation_vector({0, 0, 0.1})}, 0.0);
  ASSERT_GE(kept.size(), 7u);
  ASSERT_LE(kept.size(), 8u);
  std::vector<double> angles;
  for (const Contact& c : kept) {
    EXPECT_GT(std::hypot(c.point.x, c.point.y), 0.98);
    angles.push_back(std::atan2(c.point.y, c.point.x));
  }
  std::sort(angles.begin(), angles.end());
  for (std::size_t k = 1; k < angles.size(); ++k) EXPECT_LT(angles[k] - angles[k - 1], 1.2);
}

// Law: a box on its edge touches a face along a line, a box on its corner in a point.
TEST(Manifold, edge_gives_a_line_and_corner_a_point) {
  const Solid floor = box_solid({5, 5, 1}), box = box_solid({0.5, 0.5, 0.5});
  PairScene scene{floor.data, box.data};
  Polyhedron phase;
  const Quat on_edge = from_rotation_vector({0.5 * kQuarter, 0, 0});
  const double half_diagonal = 0.5 * std::numbers::sqrt2;
  const ContactBuffer line = scene.collide(phase, {}, {{0, 0, 1 + half_diagonal - 1e-4}, on_edge}, 1e-3);
  ASSERT_EQ(line.size(), 2u);
  for (const Contact& c : line) {
    EXPECT_NEAR(std::abs(c.point.x), 0.5, 1e-12);
    EXPECT_NEAR(c.point.y, 0.0, 1e-12);
    EXPECT_NEAR(c.gap, -1e-4, 1e-12);
  }
  const Quat on_corner = rotation_between(normalized(Vec3{1, 1, 1}), {0, 0, -1});
  const double radius = 0.5 * std::numbers::sqrt3;
  const ContactBuffer point = scene.collide(phase, {}, {{0, 0, 1 + radius - 1e-4}, on_corner}, 1e-3);
  ASSERT_EQ(point.size(), 1u);
  EXPECT_NEAR(point[0].gap, -1e-4, 1e-12);
}

// Law: edges that cross touch in one point, across both.
TEST(Manifold, crossed_edges_touch_in_a_point) {
  const Solid box = box_solid({0.5, 0.5, 0.5});
  const double half_diagonal = 0.5 * std::numbers::sqrt2;
  PairScene scene{box.data, box.data};
  Polyhedron phase;
  const Quat a = from_rotation_vector({0.5 * kQuarter, 0, 0}), b = from_rotation_vector({0, 0.5 * kQuarter, 0});
  for (const double gap : {-1e-3, 1e-3}) {
    const ContactBuffer one = scene.collide(phase, {{}, a}, {{0.1, 0.2, 2 * half_diagonal + gap}, b}, 2e-3);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_NEAR(one[0].gap, gap, 1e-12);
    EXPECT_LT(norm(one[0].normal - Vec3{0, 0, 1}), 1e-12);
    EXPECT_LT(norm(one[0].point - Vec3{0.1, 0.0, half_diagonal + 0.5 * gap}), 1e-12);
  }
}

// Law: a box that rests on another one keeps its features and its normal under the noise of a solver, so that impulses of
// the last step are found again.
TEST(Manifold, features_hold_still_under_noise) {
  RandomNumbers random{5};
  const Solid box = box_solid({0.5, 0.4, 0.3});
  for (const Vec3& offset : {Vec3{0.11, 0.07, 0.6}, Vec3{0.0, 0.0, 0.6}, Vec3{0.5, 0.0, 0.6}}) {
    PairScene scene{box.data, box.data};
    Polyhedron phase;
    const auto first = features(scene.collide(phase, {}, {offset, {}}, 1e-3));
    EXPECT_EQ(first.size(), 4u);
    for (int trial = 0; trial < trials(200); ++trial) {
      const Pose shaken{offset + random.in_cube(1e-7), from_rotation_vector(random.in_cube(1e-7))};
      const ContactBuffer contacts = scene.collide(phase, {}, shaken, 1e-3);
      EXPECT_EQ(features(contacts), first);
      EXPECT_LT(norm(contacts[0].normal - Vec3{0, 0, 1}), 1e-6) << "no flip to an edge";
    }
  }
}

}  // namespace
}  // namespace scree
