// The walk of Gilbert, Johnson and Keerthi proves its own answer: no two points are nearer than the supporting planes across the
// normal, and none farther than the two ends. Poses that all but touch and solids of very different size are where rounding shows.
#include "gjk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "penetration.hpp"
#include "support/trials.hpp"
#include "testing_solids.hpp"

namespace scree::polyhedron {
namespace {

using namespace test;

/// What is asked of every answer, in sizes of the smaller solid: a walk that ends touching does so within 1e-8.
constexpr double kAllowed = 2e-8;

Solid random_solid(RandomNumbers& random, double scale) {
  switch (random.below(3)) {
    case 0:
      return box_solid(scale * Vec3{random.uniform(0.3, 0.6), random.uniform(0.3, 0.6), random.uniform(0.3, 0.6)});
    case 1:
      return prism(3 + static_cast<int>(random.below(9)), 0.7 * scale, 0.5 * scale);
    default:
      return random_hull(random, 6 + random.below(11), scale);
  }
}

/// b beside a: turned anyhow, or by next to nothing; then to a gap of any magnitude down to 1e-12, and slid along.
Pose near_pose(RandomNumbers& random, const Polytope& a, const Pose& pose_a, const Polytope& b, double smaller) {
  Pose pose;
  pose.orientation =
      random.below(2) == 0
          ? random.rotation()
          : normalized(pose_a.orientation * from_rotation_vector(random.decades(1e-12, 1e-2) * random.direction()));
  pose.position = pose_a.position + 3.0 * (a.size + b.size) * random.direction();
  const Distance d = distance({a, pose_a, b, pose}, 1e300);
  const double wanted = random.uniform(-1, 1) * smaller * std::pow(10.0, -random.uniform(0, 12));
  pose.position += rotate(pose_a.orientation, (wanted - d.length) * d.normal);
  if (random.below(2) == 0) {
    const Vec3 across = normalized(cross(d.normal, random.direction()));
    pose.position += rotate(pose_a.orientation, random.uniform(0, smaller) * across);
  }
  return pose;
}

/// How far a point of the frame of a lies outside of a solid with faces [m].
double outside(const Polytope& solid, const Vec3& p) {
  double most = -1e300;
  for (const Face& face : solid.faces) most = std::max(most, dot(face.normal, p) - face.offset);
  return most;
}

// Law: apart, the length is that between the ends, which lie on the solids, and that of the planes across the normal. Touching,
// the ends are one point of both.
TEST(Walk, proves_its_answer) {
  RandomNumbers random{7};
  int apart = 0, touching = 0;
  for (int trial = 0; trial < trials(3000); ++trial) {
    const double scale = random.decades(1e-4, 10.0), other = scale * random.decades(0.01, 100.0);
    ShapeSet shapes;
    shapes.add(shape_data(random_solid(random, scale).data));
    shapes.add(shape_data(random_solid(random, other).data));
    PolytopeSet set;
    set.add(shapes, 0);
    const Polytope a = set[0], b = set[1];
    const Pose pose_a = random.pose(3.0 * scale);
    const Pose pose_b = near_pose(random, a, pose_a, b, std::min(scale, other));
    const PlacedPair pair{a, pose_a, b, pose_b};
    const double allowed = kAllowed * pair.size;
    const Distance d = distance(pair, 1e300);
    ASSERT_NE(d.approach, Approach::beyond);
    EXPECT_NEAR(norm(d.on_b - d.on_a), d.length, allowed);
    EXPECT_LT(outside(a, d.on_a), allowed);
    EXPECT_LT(outside(b, pair.to_b(d.on_b)), allowed);
    if (d.approach == Approach::apart) {
      EXPECT_NEAR(pair.separation(d.normal), d.length, allowed);
      ++apart;
    } else {
      ++touching;
    }
    if (HasFailure()) FAIL() << "trial " << trial;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(touching, 500);
}

// Law: where they touch, the axis is the best of all normals of faces and of all pairs of edges; edges that are better by less than
// 1e-6 of the size are passed over.
TEST(Penetration, no_axis_is_better) {
  RandomNumbers random{8};
  int touching = 0;
  AxisScratch scratch;
  for (int trial = 0; trial < trials(1000); ++trial) {
    const double scale = random.decades(1e-4, 10.0), other = scale * random.decades(0.1, 10.0);
    ShapeSet shapes;
    shapes.add(shape_data(random_solid(random, scale).data));
    shapes.add(shape_data(random_solid(random, other).data));
    PolytopeSet set;
    set.add(shapes, 0);
    const Polytope a = set[0], b = set[1];
    const Pose pose_a = random.pose(scale);
    const PlacedPair pair{a, pose_a, b, near_pose(random, a, pose_a, b, std::min(scale, other))};
    const Distance d = distance(pair, 1e300);
    if (d.approach != Approach::touching) continue;
    ++touching;
    double best = -1e300;
    for (const Face& face : a.faces) best = std::max(best, pair.separation(face.normal));
    for (const Face& face : b.faces) best = std::max(best, pair.separation(-(pair.turn * face.normal)));
    for (const Edge& one : a.edges) {
      const Vec3 u = a.corner(one.to) - a.corner(one.from);
      for (const Edge& two : b.edges) {
        const Vec3 v = pair.corner_b(two.to) - pair.corner_b(two.from), across = cross(u, v);
        if (squared_norm(across) < 1e-9 * squared_norm(u) * squared_norm(v)) continue;
        best = std::max({best, pair.separation(normalized(across)), pair.separation(-normalized(across))});
      }
    }
    EXPECT_NEAR(penetration(pair, 0.5 * (d.on_a + d.on_b), scratch).separation, best, 1.1e-6 * pair.size)
        << "trial " << trial;
  }
  EXPECT_GT(touching, 100);
}

}  // namespace
}  // namespace scree::polyhedron
