// A sphere against each convex solid, over random poses and sizes from 0.1 mm to 10 m.
//
// No reference algorithm is needed: convexity gives certificates. Outside, q is the nearest point when it belongs to the
// solid and the plane through q across the normal has the whole solid behind it. Inside, the depth is the least distance
// over all directions to the plane that supports the solid.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "sphere_cluster.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"
#include "support/trials.hpp"

namespace scree {
namespace {

using namespace test;

/// A solid of size about one: what it is, its support function max over the solid of dot(direction, x), and how far
/// outside of it a point is (<= 0 for points of the solid), all written down independently of the code under test.
struct ConvexCase {
  std::string name;
  std::function<PrimitiveData(double scale)> data;
  std::function<double(const Vec3& direction)> support;
  std::function<double(const Vec3& point)> excess;
};

double absolute_dot(const Vec3& n, const Vec3& h) {
  return std::abs(n.x) * h.x + std::abs(n.y) * h.y + std::abs(n.z) * h.z;
}

// A pyramid over a triangle, without symmetry.
const std::vector<Vec3> kCorners{{-0.5, -0.4, -0.3}, {0.6, -0.3, -0.4}, {0.1, 0.7, -0.2}, {0.0, 0.1, 0.6}};
const std::vector<Triangle> kSides{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::vector<Vec3> scaled(std::vector<Vec3> points, double scale) {
  for (Vec3& p : points) p *= scale;
  return points;
}

double corner_support(const Vec3& n) {
  double most = -1e300;
  for (const Vec3& v : kCorners) most = std::max(most, dot(n, v));
  return most;
}

double pyramid_excess(const Vec3& p) {
  double most = -1e300;
  for (const Triangle& t : kSides) {
    const Vec3 n = normalized(cross(kCorners[t[1]] - kCorners[t[0]], kCorners[t[2]] - kCorners[t[0]]));
    most = std::max(most, dot(n, p - kCorners[t[0]]));
  }
  return most;
}

/// Zero on the surface, with slope one across it.
double ellipsoid_excess(const Vec3& p) {
  const Vec3 q{p.x / 0.5, p.y / 0.2, p.z / 0.7};
  const Vec3 slope{q.x / 0.5, q.y / 0.2, q.z / 0.7};
  return 0.5 * (squared_norm(q) - 1.0) / std::max(norm(slope), 1e-3);
}

std::vector<ConvexCase> cases() {
  const Vec3 box{0.7, 0.5, 0.3};
  const auto plain = [](ShapeKind kind, Vec3 size) {
    return [kind, size](double scale) { return primitive_data(kind, scale * size); };
  };
  return {{"sphere", plain(ShapeKind::sphere, {0.6, 0, 0}), [](const Vec3&) { return 0.6; },
           [](const Vec3& p) { return norm(p) - 0.6; }},
          {"box", plain(ShapeKind::box, box), [box](const Vec3& n) { return absolute_dot(n, box); },
           [box](const Vec3& p) {
             return std::max({std::abs(p.x) - box.x, std::abs(p.y) - box.y, std::abs(p.z) - box.z});
           }},
          {"cylinder", plain(ShapeKind::cylinder, {0.4, 0.6, 0}),
           [](const Vec3& n) { return 0.4 * std::hypot(n.x, n.y) + 0.6 * std::abs(n.z); },
           [](const Vec3& p) { return std::max(std::hypot(p.x, p.y) - 0.4, std::abs(p.z) - 0.6); }},
          {"capsule", plain(ShapeKind::capsule, {0.3, 0.5, 0}), [](const Vec3& n) { return 0.3 + 0.5 * std::abs(n.z); },
           [](const Vec3& p) {
             return norm(p - Vec3{0, 0, std::clamp(p.z, -0.5, 0.5)}) - 0.3;
           }},
          {"cone", plain(ShapeKind::cone, {0.5, 0.6, 0}),
           [](const Vec3& n) { return std::max(0.6 * n.z, 0.5 * std::hypot(n.x, n.y) - 0.6 * n.z); },
           // Below the apex the radius grows by 0.5 over a height of 1.2.
           [](const Vec3& p) { return std::max(-0.6 - p.z, std::hypot(p.x, p.y) - 0.5 * (0.6 - p.z) / 1.2); }},
          {"ellipsoid", plain(ShapeKind::ellipsoid, {0.5, 0.2, 0.7}),
           [](const Vec3& n) {
             return norm(hadamard(n, {0.5, 0.2, 0.7}));
           },
           ellipsoid_excess},
          {"hull", [](double scale) { return hull_data(scaled(kCorners, scale), kSides); }, corner_support,
           pyramid_excess}};
}

class SphereAgainstConvex : public testing::TestWithParam<ConvexCase> {};

// Law: the certificates above, for spheres outside, touching, overlapping, and with the centre inside.
TEST_P(SphereAgainstConvex, contact_is_through_the_nearest_point) {
  const ConvexCase& solid = GetParam();
  RandomNumbers random{3};
  int inside = 0;
  for (int trial = 0; trial < trials(400); ++trial) {
    const double scale = random.decades(1e-4, 10.0);
    const double r = random.decades(0.01, 10.0);  // in units of scale, as everything below
    const Vec3 centre = trial % 2 == 0 ? random.in_cube(0.5) : (0.5 + r) * random.direction() + random.in_cube(0.3);
    const Pose pose = random.pose(5.0 * scale);
    PairScene scene{sphere_data(r * scale), solid.data(scale)};
    SphereCluster fresh;
    const ContactBuffer contacts =
        scene.collide(fresh, {transform(pose, scale * centre), random.rotation()}, pose, 1e3 * scale);
    ASSERT_EQ(contacts.size(), 1u);
    const double gap = contacts[0].gap / scale;
    const double distance = gap + r;
    // Normal out of the solid, in its frame; positions are up to ten units away, so rounding costs 1e-15 * 10.
    const Vec3 n = -rotate_back(pose.orientation, contacts[0].normal);
    const double tolerance = 1e-11 * (1.0 + r);
    EXPECT_NEAR(norm(n), 1.0, 1e-12);
    const Vec3 surface = centre - distance * n;
    EXPECT_LT(solid.excess(surface), tolerance) << "the nearest point belongs to the solid";
    EXPECT_NEAR(solid.support(n), dot(n, surface), tolerance) << "the solid lies behind the tangent plane";
    EXPECT_EQ(distance > tolerance, solid.excess(centre) > tolerance);
    if (distance < 0.0) {
      ++inside;
      for (int k = 0; k < 200; ++k) {
        const Vec3 m = random.direction();
        EXPECT_GE(solid.support(m) - dot(m, centre), -distance - tolerance) << "no shorter way out";
      }
    }
    const Vec3 middle = transform_back(pose, contacts[0].point) / scale;
    EXPECT_LT(norm(middle - (centre - (r + 0.5 * gap) * n)), tolerance) << "midway between the surfaces";
  }
  EXPECT_GT(inside, 20);
}

// Law: what the pair is called changes nothing but the direction of the normal.
TEST_P(SphereAgainstConvex, swapping_turns_the_normal_round) {
  RandomNumbers random{4};
  for (int trial = 0; trial < trials(100); ++trial) {
    const Pose ball = random.pose(1.0);
    const Pose other = random.pose(1.0);
    SphereCluster phase, swapped_phase;
    PairScene scene{sphere_data(0.2), GetParam().data(1.0)};
    PairScene swapped_scene{GetParam().data(1.0), sphere_data(0.2)};
    const ContactBuffer one = scene.collide(phase, ball, other, 10.0);
    const ContactBuffer two = swapped_scene.collide(swapped_phase, other, ball, 10.0);
    ASSERT_EQ(one.size(), two.size());
    EXPECT_NEAR(one[0].gap, two[0].gap, 1e-14);
    EXPECT_LT(norm(one[0].normal + two[0].normal), 1e-13);
    EXPECT_LT(norm(one[0].point - two[0].point), 1e-14 * 10);
  }
}

// Law: contacts are passed on up to the reach, and not beyond.
TEST_P(SphereAgainstConvex, reach_is_respected) {
  SphereCluster phase;
  PairScene scene{sphere_data(0.2), GetParam().data(1.0)};
  const Pose above{{0.05, 0.02, 1.5}, {}};
  const ContactBuffer far = scene.collide(phase, above, {}, 10.0);
  ASSERT_EQ(far.size(), 1u);
  ASSERT_GT(far[0].gap, 0.1);
  EXPECT_EQ(scene.collide(phase, above, {}, far[0].gap * 1.000001).size(), 1u);
  EXPECT_TRUE(scene.collide(phase, above, {}, far[0].gap * 0.999999).empty());
}

INSTANTIATE_TEST_SUITE_P(solids, SphereAgainstConvex, testing::ValuesIn(cases()),
                         [](const auto& chosen) { return chosen.param.name; });

}  // namespace
}  // namespace scree
