#include "sphere_cluster.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"
#include "support/trials.hpp"

namespace scree {
namespace {

using namespace test;

std::vector<Sphere> random_spheres(RandomNumbers& random, std::size_t count) {
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < count; ++i) spheres.push_back({random.in_cube(0.5), random.uniform(0.1, 0.3)});
  return spheres;
}

/// Gap and normal of two spheres [m], from the definition.
double gap_of(const Vec3& a, double ra, const Vec3& b, double rb) { return norm(b - a) - ra - rb; }

TEST(SphereCluster, supports_round_against_all_and_planes_against_all_but_planes) {
  const SphereCluster phase;
  for (std::size_t k = 0; k < kShapeKindCount; ++k) {
    const auto kind = static_cast<ShapeKind>(k);
    EXPECT_TRUE(phase.supports(ShapeKind::sphere, kind) && phase.supports(kind, ShapeKind::sphere));
    EXPECT_TRUE(phase.supports(ShapeKind::sphere_cluster, kind) && phase.supports(kind, ShapeKind::sphere_cluster));
    EXPECT_EQ(phase.supports(ShapeKind::plane, kind), kind != ShapeKind::plane);
  }
  EXPECT_FALSE(phase.supports(ShapeKind::box, ShapeKind::box));
  EXPECT_FALSE(phase.supports(ShapeKind::convex_hull, ShapeKind::triangle_mesh));
}

TEST(SphereCluster, sphere_on_a_plane) {
  SphereCluster phase;
  PairScene scene{plane_data(), sphere_data(1e-3)};
  const ContactBuffer contacts = scene.collide(phase, {{0, 0, 0.5}, {}}, {{3, 4, 0.5 + 0.9e-3}, {}}, 0.0);
  ASSERT_EQ(contacts.size(), 1u);
  // Tolerance: the spacing of doubles at 0.5, where the difference is taken.
  EXPECT_NEAR(contacts[0].gap, -1e-4, 2e-16);
  EXPECT_EQ(contacts[0].normal, (Vec3{0, 0, 1}));
  EXPECT_NEAR(contacts[0].point.z, 0.5 - 0.5e-4, 2e-16);
  EXPECT_EQ(contacts[0].a, 0u);
  EXPECT_EQ(contacts[0].b, 1u);
}

TEST(SphereCluster, concentric_spheres_have_some_normal) {
  SphereCluster phase;
  PairScene scene{sphere_data(1.0), sphere_data(2.0)};
  const ContactBuffer contacts = scene.collide(phase, {}, {}, 0.0);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].gap, -3.0);
  EXPECT_EQ(norm(contacts[0].normal), 1.0);
}

// Law: two clusters touch where their spheres do, sphere by sphere.
TEST(SphereCluster, clusters_touch_as_their_spheres) {
  RandomNumbers random{8};
  std::size_t found = 0;
  for (int trial = 0; trial < trials(200); ++trial) {
    const auto of_a = random_spheres(random, 1 + random.below(32));
    const auto of_b = random_spheres(random, 1 + random.below(32));
    const Pose a = random.pose(0.6), b = random.pose(0.6);
    const double reach = random.uniform(0.0, 0.1);
    SphereCluster phase;
    PairScene scene{cluster_data(of_a), cluster_data(of_b)};
    const ContactBuffer contacts = scene.collide(phase, a, b, reach);
    std::size_t at = 0;
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      for (std::size_t j = 0; j < of_b.size(); ++j) {
        const Vec3 ca = transform(a, of_a[i].centre), cb = transform(b, of_b[j].centre);
        const double gap = gap_of(ca, of_a[i].radius, cb, of_b[j].radius);
        if (gap >= reach) continue;
        ASSERT_LT(at, contacts.size());
        EXPECT_NEAR(contacts[at].gap, gap, 1e-14);
        EXPECT_LT(norm(contacts[at].normal - normalized(cb - ca)), 1e-12);
        ++at;
      }
    }
    EXPECT_EQ(at, contacts.size());
    found += at;
    EXPECT_TRUE(std::is_sorted(contacts.begin(), contacts.end(),
                               [](const Contact& l, const Contact& r) { return l.feature < r.feature; }));
  }
  EXPECT_GT(found, 500u);
}

// Law: a cluster touches a solid as each of its spheres alone does, whatever the solid.
TEST(SphereCluster, cluster_touches_solids_as_its_spheres) {
  RandomNumbers random{9};
  const std::vector<PrimitiveData> solids{primitive_data(ShapeKind::box, {0.6, 0.4, 0.3}),
                                          primitive_data(ShapeKind::cylinder, {0.4, 0.5, 0}),
                                          primitive_data(ShapeKind::cylinder, {1.2, 1.0, 0}, true),
                                          primitive_data(ShapeKind::cone, {0.4, 0.5, 0}),
                                          primitive_data(ShapeKind::capsule, {0.4, 0.5, 0}),
                                          primitive_data(ShapeKind::ellipsoid, {0.4, 0.5, 0.3}),
                                          plane_data()};
  for (const PrimitiveData& solid : solids) {
    for (int trial = 0; trial < trials(50); ++trial) {
      const auto spheres = random_spheres(random, 8);
      const Pose pose = random.pose(0.7), other = random.pose(0.2);
      SphereCluster phase;
      PairScene scene{cluster_data(spheres), solid};
      const ContactBuffer contacts = scene.collide(phase, pose, other, 0.05);
      std::size_t at = 0;
      for (const Sphere& s : spheres) {
        SphereCluster single_phase;
        PairScene single{sphere_data(s.radius), solid};
        for (const Contact& c : single.collide(single_phase, {transform(pose, s.centre), {}}, other, 0.05)) {
          ASSERT_LT(at, contacts.size());
          EXPECT_NEAR(contacts[at].gap, c.gap, 1e-14);
          EXPECT_LT(norm(contacts[at].normal - c.normal), 1e-11);
          EXPECT_LT(norm(contacts[at].point - c.point), 1e-13);
          ++at;
        }
      }
      EXPECT_EQ(at, contacts.size());
    }
  }
}

// Law: in a corner of a drum a sphere touches the mantle and the lid, at distances that geometry gives.
TEST(SphereCluster, drum_holds_a_sphere_from_inside) {
  SphereCluster phase;
  PairScene scene{primitive_data(ShapeKind::cylinder, {0.5, 1.0, 0}, true), sphere_data(0.1)};
  const ContactBuffer mantle = scene.collide(phase, {}, {{0.3, 0.0, 0.0}, {}}, 0.15);
  ASSERT_EQ(mantle.size(), 1u);
  EXPECT_NEAR(mantle[0].gap, 0.1, 1e-15);
  EXPECT_LT(norm(mantle[0].normal - Vec3{-1, 0, 0}), 1e-15) << "from the drum to the sphere: inwards";
  EXPECT_LT(norm(mantle[0].point - Vec3{0.45, 0, 0}), 1e-15);
  const ContactBuffer corner = scene.collide(phase, {}, {{0.0, 0.42, -0.93}, {}}, 0.0);
  ASSERT_EQ(corner.size(), 2u);
  EXPECT_NEAR(corner[0].gap, -0.02, 1e-15);
  EXPECT_NEAR(corner[1].gap, -0.03, 1e-15);
  EXPECT_LT(norm(corner[1].normal - Vec3{0, 0, 1}), 1e-15);
  EXPECT_TRUE(scene.collide(phase, {}, {{0.65, 0, 0}, {}}, 0.0).empty()) << "outside of the drum";
}

// Law: a solid rests on a plane on its lowest points; each gap is the height of such a point.
TEST(SphereCluster, box_stands_on_a_plane_on_its_corners) {
  RandomNumbers random{10};
  const Vec3 half{0.3, 0.2, 0.1};
  for (int trial = 0; trial < trials(100); ++trial) {
    const Pose box = random.pose(0.2), plane = random.pose(0.2);
    SphereCluster phase;
    PairScene scene{primitive_data(ShapeKind::box, half), plane_data()};
    const ContactBuffer contacts = scene.collide(phase, box, plane, 0.1);
    std::size_t at = 0;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner =
          transform(box, {(i & 1 ? 1 : -1) * half.x, (i & 2 ? 1 : -1) * half.y, (i & 4 ? 1 : -1) * half.z});
      const double height = transform_back(plane, corner).z;
      if (height >= 0.1) continue;
      ASSERT_LT(at, contacts.size());
      EXPECT_EQ(contacts[at].feature, static_cast<std::uint64_t>(i));
      EXPECT_NEAR(contacts[at].gap, height, 1e-14);
      EXPECT_LT(norm(contacts[at].normal + rotate(plane.orientation, {0, 0, 1})), 1e-14);
      ++at;
    }
    EXPECT_EQ(at, contacts.size());
  }
}

// Law: the lowest support point against a plane is as low as the solid's support function says.
TEST(SphereCluster, lowest_point_of_round_solids_on_a_plane) {
  RandomNumbers random{12};
  for (int trial = 0; trial < trials(100); ++trial) {
    const Pose pose = random.pose(0.2);
    const Vec3 down = rotate_back(pose.orientation, {0, 0, -1});
    const double side = std::hypot(down.x, down.y);
    const std::vector<std::pair<PrimitiveData, double>> solids{
        {primitive_data(ShapeKind::cylinder, {0.3, 0.5, 0}), 0.3 * side + 0.5 * std::abs(down.z)},
        {primitive_data(ShapeKind::cone, {0.3, 0.5, 0}), std::max(0.5 * down.z, 0.3 * side - 0.5 * down.z)},
        {primitive_data(ShapeKind::capsule, {0.3, 0.5, 0}), 0.3 + 0.5 * std::abs(down.z)},
        {primitive_data(ShapeKind::ellipsoid, {0.3, 0.5, 0.2}), norm(hadamard(down, {0.3, 0.5, 0.2}))}};
    for (const auto& [solid, depth] : solids) {
      SphereCluster phase;
      PairScene scene{plane_data(), solid};
      const ContactBuffer contacts = scene.collide(phase, {}, pose, 10.0);
      double lowest = 1e300;
      for (const Contact& c : contacts) lowest = std::min(lowest, c.gap);
      EXPECT_NEAR(lowest, pose.position.z - depth, 1e-14);
      EXPECT_EQ(contacts[0].normal, (Vec3{0, 0, 1}));
    }
  }
}

// Law: moving both bodies together moves the contacts with them.
TEST(SphereCluster, contacts_move_with_the_bodies) {
  RandomNumbers random{13};
  for (int trial = 0; trial < trials(100); ++trial) {
    const auto spheres = random_spheres(random, 5);
    const Pose a = random.pose(0.6), b = random.pose(0.3), motion = random.pose(3.0);
    SphereCluster phase;
    PairScene scene{cluster_data(spheres), primitive_data(ShapeKind::cone, {0.4, 0.5, 0})};
    const ContactBuffer here = scene.collide(phase, a, b, 0.05);
    const ContactBuffer there = scene.collide(phase, motion * a, motion * b, 0.05);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t k = 0; k < here.size(); ++k) {
      // Rounding of composed poses up to 4 m away.
      EXPECT_NEAR(here[k].gap, there[k].gap, 1e-14 * 10);
      EXPECT_LT(norm(transform(motion, here[k].point) - there[k].point), 1e-13 * 10);
      EXPECT_EQ(here[k].feature, there[k].feature);
    }
  }
}

}  // namespace
}  // namespace scree
