// Boxes, hulls and capsules inside a hollow cylinder.
#include "drum.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "polyhedron.hpp"
#include "support/trials.hpp"
#include "testing_solids.hpp"

namespace scree {
namespace {

using namespace test;

// Law: a convex solid is as far inside of a drum as the outermost of its corners, less the sweep: for the mantle, and for each
// lid. Every contact is midway between its corner and the wall.
TEST(Drum, corners_decide) {
  RandomNumbers random{1};
  std::size_t found = 0;
  for (int trial = 0; trial < trials(300); ++trial) {
    const double scale = random.decades(1e-4, 10.0);
    const Solid solid = trial % 3 == 0   ? box_solid(scale * Vec3{0.1, 0.2, 0.15})
                        : trial % 3 == 1 ? capsule_solid(0.08 * scale, 0.15 * scale)
                                         : random_hull(random, 16, 0.2 * scale);
    const double r = scale, h = 0.7 * scale, reach = 0.1 * scale;
    PairScene scene{primitive_data(ShapeKind::cylinder, {r, h, 0}, true), solid.data};
    Polyhedron phase;
    const Pose drum = random.pose(scale);
    const Pose inside{
        {random.uniform(-0.6, 0.6) * scale, random.uniform(-0.6, 0.6) * scale, random.uniform(-0.6, 0.6) * scale},
        random.rotation()};
    const ContactBuffer contacts = scene.collide(phase, drum, drum * inside, reach);
    std::size_t expected = 0;
    const auto is_there = [&](double gap, const Vec3& normal, const Vec3& point) {
      if (gap >= reach) return;
      ++expected;
      EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return std::abs(c.gap - gap) < 1e-13 * scale && norm(c.normal - rotate(drum.orientation, normal)) < 1e-12 &&
               norm(c.point - transform(drum, point)) < 1e-13 * 10 * scale;
      }));
    };
    for (const Vec3& p : solid.placed(inside)) {
      const double rho = std::hypot(p.x, p.y);
      const Vec3 out{p.x / rho, p.y / rho, 0.0};
      const double sweep = solid.radius;
      is_there(r - rho - sweep, -out, 0.5 * (p + sweep * out + Vec3{r * out.x, r * out.y, p.z}));
      is_there(h - p.z - sweep, {0, 0, -1}, {p.x, p.y, 0.5 * (p.z + sweep + h)});
      is_there(h + p.z - sweep, {0, 0, 1}, {p.x, p.y, 0.5 * (p.z - sweep - h)});
    }
    EXPECT_EQ(contacts.size(), expected);
    found += expected;
    for (std::size_t k = 1; k < contacts.size(); ++k) EXPECT_LT(contacts[k - 1].feature, contacts[k].feature);
  }
  EXPECT_GT(found, 100u);
}

// Law: what is far outside touches nothing; planes and drums have a right side.
TEST(Drum, outside_is_left) {
  PairScene scene{primitive_data(ShapeKind::cylinder, {0.5, 0.5, 0}, true), box_solid({0.1, 0.1, 0.1}).data};
  Polyhedron phase;
  EXPECT_TRUE(scene.collide(phase, {}, {{0.8, 0, 0}, {}}, 0.01).empty());
  EXPECT_TRUE(scene.collide(phase, {}, {{0, 0, -0.8}, {}}, 0.01).empty());
  EXPECT_TRUE(scene.collide(phase, {}, {}, 0.01).empty()) << "nor does what floats in the middle";
}

TEST(Drum, all_but_planes_and_spheres_lie_in_drums) {
  const Polyhedron phase;
  for (std::size_t k = 0; k < kShapeKindCount; ++k) {
    const auto kind = static_cast<ShapeKind>(k);
    const bool not_ours = kind == ShapeKind::plane || kind == ShapeKind::sphere || kind == ShapeKind::sphere_cluster;
    EXPECT_EQ(phase.supports_hollow(kind), !not_ours) << to_string(kind);
    EXPECT_FALSE(phase.supports(ShapeKind::cylinder, kind)) << "solid cylinders are not for this phase";
  }
}

}  // namespace
}  // namespace scree
