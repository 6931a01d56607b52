// Gap and normal of every two kinds in random and in special poses, from 0.1 mm to 10 m.
//
// The reference is the hull of all differences of corners: the gap is the origin's distance from it. A normal is right when
// the solids are apart by the gap along it, because no other direction separates them as far.
#include "polyhedron.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "support/trials.hpp"
#include "testing_difference.hpp"
#include "testing_solids.hpp"

namespace scree {
namespace {

using namespace test;

Solid solid_of(const std::string& kind, RandomNumbers& random, double scale) {
  if (kind == "box") {
    return box_solid(scale * Vec3{random.uniform(0.2, 1.0), random.uniform(0.2, 1.0), random.uniform(0.2, 1.0)});
  }
  if (kind == "capsule") return capsule_solid(random.uniform(0.1, 0.5) * scale, random.uniform(0.2, 1.0) * scale);
  if (kind == "prism")
    return prism(3 + static_cast<int>(random.below(9)), 0.7 * scale, random.uniform(0.1, 0.8) * scale);
  return random_hull(random, 4 + random.below(20), scale);
}

/// Gap of two solids with their sweeps. Two crossing segments have no hull of differences.
double expected_gap(const Solid& a, const std::vector<Vec3>& at_a, const Solid& b, const std::vector<Vec3>& at_b) {
  return reference_gap(at_a, at_b) - a.radius - b.radius;
}

/// The laws that every contact of a pair has to hold.
void check_pair(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b) {
  const double size = std::min(a.size, b.size);
  const auto at_a = a.placed(pose_a), at_b = b.placed(pose_b);
  const double gap = expected_gap(a, at_a, b, at_b);
  PairScene scene{a.data, b.data};
  Polyhedron phase;
  const double reach = std::max(gap, 0.0) + 0.2 * size;
  const ContactBuffer contacts = scene.collide(phase, pose_a, pose_b, reach);
  ASSERT_FALSE(contacts.empty());
  double least = 1e300;
  for (const Contact& c : contacts) least = std::min(least, c.gap);
  // Faces are preferred to edges that are better by up to 1e-4 of the size; positions are some sizes away from zero.
  const double tolerance = 1.5e-4 * size;
  EXPECT_NEAR(least, gap, tolerance);
  EXPECT_LT(std::abs(separation_along(contacts[0].normal, at_a, at_b) - a.radius - b.radius - gap), tolerance)
      << "the normal separates as far as any";
  std::uint64_t last = 0;
  for (const Contact& c : contacts) {
    EXPECT_NEAR(norm(c.normal), 1.0, 1e-12);
    EXPECT_EQ(c.normal, contacts[0].normal);
    EXPECT_LT(c.gap, reach);
    EXPECT_TRUE(&c == contacts.data() || c.feature > last) << "features are different and in order";
    last = c.feature;
    // Midway between the surfaces: no farther out of either solid than half the gap, or the depth.
    const double allowed = 0.5 * std::abs(c.gap) + std::max(0.0, -gap) + 1e-4 * size;
    const auto height = [&](const Vec3& n, const std::vector<Vec3>& corners, double radius) {
      double most = -1e300;
      for (const Vec3& p : corners) most = std::max(most, dot(n, p));
      return dot(n, c.point) - most - radius;
    };
    EXPECT_LE(height(c.normal, at_a, a.radius), allowed);
    EXPECT_LE(height(-c.normal, at_b, b.radius), allowed);
  }
  EXPECT_LE(contacts.size(), 8u);
  const double short_reach = gap * 0.999 - 1e-6 * size;
  if (short_reach > 0.0) {
    EXPECT_TRUE(scene.collide(phase, pose_a, pose_b, short_reach).empty()) << "out of reach";
  }
}

struct Kinds {
  std::string a, b;
};

class Pairs : public testing::TestWithParam<Kinds> {};

// Law: gap and normal of solids apart, touching and overlapping, of equal and of different sizes.
TEST_P(Pairs, gap_is_that_of_the_difference) {
  RandomNumbers random{1};
  int apart = 0, deep = 0;
  for (int trial = 0; trial < trials(100); ++trial) {
    const double scale = random.decades(1e-4, 10.0);
    const Solid a = solid_of(GetParam().a, random, scale);
    const Solid b = solid_of(GetParam().b, random, trial % 3 == 0 ? scale * random.decades(0.05, 20.0) : scale);
    const Pose pose_a = random.pose(3.0 * scale);
    const double distance = random.uniform(0.0, 1.2) * (a.size + b.size);
    const Pose pose_b{pose_a.position + distance * random.direction(), random.rotation()};
    check_pair(a, pose_a, b, pose_b);
    const double gap = expected_gap(a, a.placed(pose_a), b, b.placed(pose_b));
    apart += gap > 0.0;
    deep += gap < -0.1 * std::min(a.size, b.size);
    if (HasFailure()) FAIL() << "trial " << trial;
  }
  EXPECT_GT(apart, 10);
  EXPECT_GT(deep, 10);
}

// Law: the same close to touching, where a distance becomes a depth.
TEST_P(Pairs, touching_is_seen_from_both_sides) {
  RandomNumbers random{2};
  for (int trial = 0; trial < trials(100); ++trial) {
    const double scale = random.decades(1e-4, 10.0);
    const Solid a = solid_of(GetParam().a, random, scale);
    const Solid b = solid_of(GetParam().b, random, scale);
    const Pose pose_a = random.pose(scale);
    Pose pose_b{pose_a.position + 1.5 * (a.size + b.size) * random.direction(), random.rotation()};
    PairScene scene{a.data, b.data};
    Polyhedron phase;
    const ContactBuffer contacts = scene.collide(phase, pose_a, pose_b, 1e3 * scale);
    ASSERT_FALSE(contacts.empty());
    // Along the normal the gap closes by what b moves.
    const double wanted = random.uniform(-1.0, 1.0) * scale * std::pow(10.0, -random.uniform(2.0, 12.0));
    double least = 1e300;
    for (const Contact& c : contacts) least = std::min(least, c.gap);
    pose_b.position += (wanted - least) * contacts[0].normal;
    check_pair(a, pose_a, b, pose_b);
    if (HasFailure()) FAIL() << "trial " << trial;
  }
}

/// A turn by quarters about two axes.
Quat quarter_turns(RandomNumbers& random) {
  const auto quarters = [&](const Vec3& axis) {
    return from_rotation_vector(0.5 * std::numbers::pi * static_cast<double>(random.below(4)) * axis);
  };
  return normalized(quarters({0, 0, 1}) * quarters({1, 0, 0}));
}

// Law: the same with parallel faces and edges, with tilts from nothing to a degree, and with one centre in the other.
TEST_P(Pairs, parallel_faces_and_edges_and_common_centres) {
  RandomNumbers random{4};
  for (int trial = 0; trial < trials(100); ++trial) {
    const Solid a = solid_of(GetParam().a, random, 1.0), b = solid_of(GetParam().b, random, 1.0);
    const Quat tilt =
        from_rotation_vector(random.below(3) == 0 ? Vec3{} : random.decades(1e-12, 2e-2) * random.direction());
    const Pose pose_a = random.pose(1.0);
    // The offset has one, two or three components, or none.
    Vec3 offset;
    for (int axis = 0; axis < 3; ++axis) {
      if (random.below(2) == 0) offset[axis] = random.uniform(-1.5, 1.5);
    }
    check_pair(a, pose_a, b, pose_a * Pose{offset, normalized(quarter_turns(random) * tilt)});
    if (HasFailure()) FAIL() << "trial " << trial;
  }
}

// Law: swapping a and b turns the normals round and leaves the points where they are.
TEST_P(Pairs, swapping_turns_the_normals_round) {
  RandomNumbers random{3};
  for (int trial = 0; trial < trials(100); ++trial) {
    const Solid a = solid_of(GetParam().a, random, 1.0), b = solid_of(GetParam().b, random, 1.0);
    const Pose pose_a = random.pose(0.6), pose_b = random.pose(0.6);
    Polyhedron phase, other;
    PairScene scene{a.data, b.data}, swapped{b.data, a.data};
    const ContactBuffer one = scene.collide(phase, pose_a, pose_b, 0.2),
                        two = swapped.collide(other, pose_b, pose_a, 0.2);
    ASSERT_EQ(one.empty(), two.empty());
    if (one.empty()) continue;
    const auto least = [](const ContactBuffer& contacts) {
      double gap = 1e300;
      for (const Contact& c : contacts) gap = std::min(gap, c.gap);
      return gap;
    };
    EXPECT_NEAR(least(one), least(two), 1.5e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, Pairs,
                         testing::Values(Kinds{"box", "box"}, Kinds{"box", "hull"}, Kinds{"hull", "hull"},
                                         Kinds{"prism", "hull"}, Kinds{"prism", "prism"}, Kinds{"box", "prism"},
                                         Kinds{"capsule", "box"}, Kinds{"hull", "capsule"}, Kinds{"prism", "capsule"}),
                         [](const auto& chosen) { return chosen.param.a + "_" + chosen.param.b; });

}  // namespace
}  // namespace scree
