#include "granular/rolling_resistance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scree/config/validate.hpp"

namespace scree::granular {
namespace {

constexpr double kArm = 1e-3, kSpinArm = 2e-4, kLoad = 10.0, kStiffness = 1e5;

/// A contact along z with a load of 10 N, of a material that has both arms.
struct One {
  explicit One(const std::string& toml) : rolling{options_from_text(toml, RollingResistance::parameters())} {
    materials.add({.name = "rubber",
                   .density = 1000.0,
                   .contact = {.rolling_friction = kArm, .spinning_friction = kSpinArm},
                   .attributes = {}});
    rolling.setup(materials);
    batch.count = 1;
    batch.normal.set(0, {0, 0, 1});
    batch.radius[0] = 0.01, batch.mass[0] = 0.01;
    batch.lead = 0.0;
    lanes.load[0] = kLoad, lanes.stiffness[0] = kStiffness;
  }
  Vec3 turn(const Vec3& by) {
    batch.spin.set(0, by);
    batch.ahead[0] = 1.0;
    rolling.add(batch, lanes, 3);
    return batch.torque[0];
  }
  Materials materials;
  RollingResistance rolling;
  ContactBatch batch{};
  ContactLanes lanes{};
};

TEST(rolling_resistance, of_a_constant_moment_opposes_each_part_with_its_own_arm) {
  One contact{"rolling = \"constant_directional\"\nspinning = \"constant_directional\""};
  EXPECT_LE(norm(contact.turn({3.0, 4.0, -7.0}) - Vec3{-0.6 * kArm * kLoad, -0.8 * kArm * kLoad, kSpinArm * kLoad}),
            1e-16);
  EXPECT_EQ(contact.turn({}), Vec3{});
  EXPECT_EQ(contact.rolling.history_size(), 0U);
}

// What rounding leaves of a spin in the tangent plane is no rolling, and what it leaves of a rolling along the normal no spin.
TEST(rolling_resistance, of_a_constant_moment_takes_no_rounding_for_motion) {
  One rolls{"rolling = \"constant_directional\""}, spins{"spinning = \"constant_directional\""};
  for (int i = 0; i < 200; ++i) {
    const double height = -0.995 + 0.01 * i, angle = 2.4 * i, across = std::sqrt(1.0 - height * height);
    const Vec3 normal{across * std::cos(angle), across * std::sin(angle), height};
    const Vec3 tangent{std::sin(angle), -std::cos(angle), 0.0};
    for (One* contact : {&rolls, &spins}) contact->batch.normal.set(0, normal);
    EXPECT_EQ(rolls.turn(20.0 * normal), Vec3{}) << i;
    EXPECT_EQ(spins.turn(20.0 * tangent), Vec3{}) << i;
    // A little rolling beside much spin: all of the moment lies in the tangent plane and against it.
    const Vec3 torque = rolls.turn(20.0 * normal + 1e-9 * tangent);
    EXPECT_LE(norm(torque + kArm * kLoad * tangent), 1e-4 * kArm * kLoad) << i;  // 20 x 2e-16 beside 1e-9, and some
    EXPECT_LE(std::abs(dot(torque, normal)), 1e-15 * kArm * kLoad) << i;
  }
}

TEST(rolling_resistance, acts_on_what_it_is_asked_to_alone) {
  One rolls{"rolling = \"constant_directional\""}, spins{"spinning = \"elastic_plastic\""}, none{""};
  EXPECT_EQ(rolls.turn({0, 0, 5.0}), Vec3{});
  EXPECT_EQ(spins.turn({5.0, 0, 0}), Vec3{});
  EXPECT_FALSE(none.rolling.acts());
}

TEST(rolling_resistance, names_the_arm_that_no_model_reads) {
  const One rolls{"rolling = \"constant_directional\""}, spins{"spinning = \"elastic_plastic\""},
      both{"rolling = \"constant_directional\"\nspinning = \"elastic_plastic\""};
  const ContactMaterial arms{.rolling_friction = kArm, .spinning_friction = kSpinArm};
  ASSERT_TRUE(rolls.rolling.unread(arms));
  EXPECT_EQ(rolls.rolling.unread(arms)->key, "spinning_friction");
  ASSERT_TRUE(spins.rolling.unread(arms));
  EXPECT_EQ(spins.rolling.unread(arms)->key, "rolling_friction");
  EXPECT_FALSE(both.rolling.unread(arms));
  EXPECT_FALSE(rolls.rolling.unread({.rolling_friction = kArm}));
  EXPECT_FALSE(spins.rolling.unread({.friction = 0.5}));
}

// Ai et al.: k = 2.25 kn (mu_r R)^2, up to mu_r R N.
TEST(rolling_resistance, of_the_elastic_plastic_model_is_a_spring_up_to_its_limit) {
  One contact{"rolling = \"elastic_plastic\"\nspinning = \"elastic_plastic\"\nrolling_damping = 0.0"};
  const double stiffness = 2.25 * kStiffness * kArm * kArm, spin_stiffness = 2.25 * kStiffness * kSpinArm * kSpinArm;
  EXPECT_EQ(contact.rolling.history_size(), 4U);
  EXPECT_LE(norm(contact.turn({1e-3, 2e-3, 3e-3}) - Vec3{-stiffness * 1e-3, -stiffness * 2e-3, -spin_stiffness * 3e-3}),
            1e-16);
  EXPECT_LE(norm(contact.turn({3.0, 4.0, -5.0}) - Vec3{-0.6 * kArm * kLoad, -0.8 * kArm * kLoad, kSpinArm * kLoad}),
            1e-5);
  const Vec3 back = contact.turn({-1e-3, 0, 0});
  EXPECT_NEAR(std::hypot(back.x, back.y), kArm * kLoad - 0.6 * stiffness * 1e-3, 5e-6);  // and a little to the side
}

TEST(rolling_resistance, never_exceeds_its_limit_with_the_dashpot) {
  One contact{"rolling = \"elastic_plastic\"\nspinning = \"elastic_plastic\"\nrolling_damping = 5.0"};
  for (const double spin : {1e-3, 1.0, -100.0, 1e4}) {
    contact.batch.ahead[0] = 0.0;
    contact.batch.spin.set(0, {spin, 0, spin});
    contact.rolling.add(contact.batch, contact.lanes, 3);
    EXPECT_LE(std::abs(contact.batch.torque.x[0]), kArm * kLoad * (1.0 + 1e-15));
    EXPECT_LE(std::abs(contact.batch.torque.z[0]), kSpinArm * kLoad * (1.0 + 1e-15));
  }
}

}  // namespace
}  // namespace scree::granular
