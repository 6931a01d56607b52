#include "gravity.hpp"

#include <gtest/gtest.h>

#include "scree/config/validate.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

Gravity gravity_from(const char* toml) { return Gravity{options_from_text(toml, Gravity::parameters())}; }

TEST(gravity, default_points_down_z_with_9_81) {
  const Gravity gravity = gravity_from("");
  Attributes attributes;
  test::TestBodies bodies{attributes};
  const std::size_t i = bodies.add_sphere(1, {0.1, 0.2, 0.3}, 1e-3, 2500.0);
  gravity.add_forces(bodies.view(), 0.0, bodies.wrenches());
  EXPECT_EQ(bodies.force[i], (Vec3{0.0, 0.0, -9.81 * bodies.mass[i]}));
  EXPECT_EQ(bodies.torque[i], Vec3{});
}

TEST(gravity, adds_to_what_other_fields_left) {
  const Gravity gravity = gravity_from("acceleration = [1.0, -2.0, 3.0]");
  Attributes attributes;
  test::TestBodies bodies{attributes};
  bodies.add_sphere(1, {}, 1e-2, 1000.0);
  const WrenchView out = bodies.wrenches();
  bodies.force[0] = {1.0, 1.0, 1.0};
  gravity.add_forces(bodies.view(), 0.0, out);
  EXPECT_EQ(bodies.force[0], (Vec3{1.0, 1.0, 1.0} + bodies.mass[0] * Vec3{1.0, -2.0, 3.0}));
}

TEST(gravity, leaves_immovable_bodies_alone) {
  const Gravity gravity = gravity_from("");
  Attributes attributes;
  test::TestBodies bodies{attributes};
  bodies.add_immovable(1, {0.0, 0.0, 1.0}, Motion::kinematic);
  bodies.add_immovable(2, {0.0, 0.0, 1.0}, Motion::fixed);
  gravity.add_forces(bodies.view(), 0.0, bodies.wrenches());
  EXPECT_EQ(bodies.force[0], Vec3{});
  EXPECT_EQ(bodies.force[1], Vec3{});
  EXPECT_EQ(gravity.potential_energy(bodies.view(), 0.0), 0.0);
}

TEST(gravity, force_is_minus_the_gradient_of_the_potential_energy) {
  const Gravity gravity = gravity_from("acceleration = [0.3, -9.7, 1.1]");
  Attributes attributes;
  test::TestBodies bodies{attributes};
  bodies.add_sphere(1, {0.4, -0.2, 0.9}, 2e-2, 946.0);
  bodies.add_sphere(2, {-0.1, 0.7, 0.2}, 1e-2, 8400.0);
  gravity.add_forces(bodies.view(), 0.0, bodies.wrenches());
  // U is linear in x, so the central difference is exact but for rounding: eps |U| / (2 delta) is about 1e-15 N here,
  // against forces of 0.01 N and more.
  constexpr double kDelta = 0.1;
  for (std::size_t i = 0; i < 2; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 kept = bodies.position[i];
      bodies.position[i][axis] = kept[axis] + kDelta;
      const double above = gravity.potential_energy(bodies.view(), 0.0);
      bodies.position[i][axis] = kept[axis] - kDelta;
      const double below = gravity.potential_energy(bodies.view(), 0.0);
      bodies.position[i] = kept;
      EXPECT_NEAR(bodies.force[i][axis], -(above - below) / (2.0 * kDelta), 1e-13);
    }
  }
}

}  // namespace
}  // namespace scree
