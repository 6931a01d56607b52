// The reference of the suite of narrow phases against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "conformance/narrow_phase_reference.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree::test {
namespace {

ReferenceSolid solid(const PrimitiveData& data, const Pose& pose) { return reference_solids(data, pose)[0]; }

constexpr double kRounding = 1e-7;  // what the search promises, for solids of size one

// Two spheres: distance of centres less radii, apart and overlapping.
TEST(NarrowPhaseReference, spheres) {
  RandomNumbers random{1};
  for (int k = 0; k < 50; ++k) {
    const double r = random.uniform(0.2, 1), s = random.uniform(0.2, 1);
    const Pose a = random.pose(1.0), b = random.pose(1.0);
    const ReferenceGap found = reference_gap(solid(sphere_data(r), a), solid(sphere_data(s), b));
    EXPECT_NEAR(found.gap, norm(b.position - a.position) - r - s, kRounding);
    EXPECT_NEAR(dot(found.normal, normalized(b.position - a.position)), 1.0, kRounding);
  }
}

// Two capsules whose axes cross at height h: h less the radii.
TEST(NarrowPhaseReference, crossed_capsules) {
  for (const double h : {0.05, 0.3, 0.7}) {
    const PrimitiveData capsule = primitive_data(ShapeKind::capsule, {0.2, 1.0, 0});
    const double c = std::sqrt(0.5);
    const ReferenceGap found =
        reference_gap(solid(capsule, {{}, {c, c, 0, 0}}), solid(capsule, {{0.3, 0.2, h}, {c, 0, c, 0}}));
    EXPECT_NEAR(found.gap, h - 0.4, kRounding);
  }
}

// A cube on its corner above a cube, its lowest corner at height h above the face.
TEST(NarrowPhaseReference, corner_over_a_face) {
  const PrimitiveData box = primitive_data(ShapeKind::box, {1, 1, 1});
  const Vec3 axis = normalized(Vec3{1, -1, 0});
  const double half = 0.5 * std::acos(1.0 / std::sqrt(3.0));
  const Quat q{std::cos(half), axis.x * std::sin(half), axis.y * std::sin(half), 0};
  for (const double h : {-0.2, 0.0, 0.4}) {
    const ReferenceGap found = reference_gap(solid(box, {}), solid(box, {{0.1, -0.2, 1.0 + std::sqrt(3.0) + h}, q}));
    EXPECT_NEAR(found.gap, h, kRounding);
    EXPECT_NEAR(found.normal.z, 1.0, kRounding);
  }
}

// A sphere inside a long cylinder on its axis, and an ellipsoid with its centre at a cube's: the shortest ways out.
TEST(NarrowPhaseReference, deep_ones) {
  const ReferenceSolid cylinder = solid(primitive_data(ShapeKind::cylinder, {0.5, 3, 0}), {});
  EXPECT_NEAR(reference_gap(cylinder, solid(sphere_data(0.2), {{0, 0, 1}, {}})).gap, -0.7, kRounding);
  const ReferenceSolid box = solid(primitive_data(ShapeKind::box, {1, 2, 3}), {});
  const ReferenceSolid ellipsoid = solid(primitive_data(ShapeKind::ellipsoid, {0.3, 0.5, 0.7}), {});
  EXPECT_NEAR(reference_gap(box, ellipsoid).gap, -1.3, kRounding);
}

// A cone's tip over a cylinder's lid; its base on it; its mantle beside a sphere: (h R + ...) by the line of the mantle.
TEST(NarrowPhaseReference, cones) {
  const PrimitiveData cone = primitive_data(ShapeKind::cone, {0.6, 1.0, 0});
  const ReferenceSolid cylinder = solid(primitive_data(ShapeKind::cylinder, {1, 1, 0}), {});
  EXPECT_NEAR(reference_gap(cylinder, solid(cone, {{0.2, 0, 2.25}, {}})).gap, 0.25, kRounding);
  EXPECT_NEAR(reference_gap(cylinder, solid(cone, {{0.2, 0, 2.25}, {0, 1, 0, 0}})).gap, 0.25, kRounding);
  const Vec3 n = normalized(Vec3{2.0, 0, 0.6});  // of the mantle
  const Vec3 on_mantle{0.3, 0, 0};
  const ReferenceGap found = reference_gap(solid(cone, {}), solid(sphere_data(0.5), {on_mantle + 0.6 * n, {}}));
  EXPECT_NEAR(found.gap, 0.1, kRounding);
  EXPECT_NEAR(dot(found.normal, n), 1.0, kRounding);
}

}  // namespace
}  // namespace scree::test
