// What the law says of itself, refuses, and asks of the step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "granular/step_limit.hpp"
#include "linear_world.hpp"

namespace scree {
namespace {

using testing::Test;

// zeta = 0.112816 of e = 0.7 until the gap is zero; pi sqrt(1e-3 / 1e4) / sqrt(1 - zeta^2) = 0.99982 ms.
TEST(linear_settings, the_log_has_stiffness_restitution_and_contact_time_of_each_pair) {
  test::FakeSceneServices services;
  const auto law = test::linear_law("stiffness = 1e4\nend_of_contact = \"gap\"", {.restitution = 0.7}, services);
  ASSERT_EQ(services.log_lines().size(), 1U);
  EXPECT_EQ(services.log_lines()[0],
            "glass on glass: stiffness 1e+04 N/m, contact time 0.9998 ms at 1 g, as the root of the mass, "
            "restitution 0.7 (damping ratio 0.1128)");
}

TEST(linear_settings, a_restitution_of_zero_takes_the_least_one_and_the_log_says_so) {
  test::FakeSceneServices services;
  const auto law = test::linear_law("stiffness = 1e4", {}, services);
  EXPECT_NE(services.log_lines()[0].find("restitution 0.05 (damping ratio 1.9"), std::string::npos)
      << services.log_lines()[0];
  EXPECT_NE(services.log_lines()[0].find(", where 0 is asked for"), std::string::npos);
}

TEST(linear_settings, a_stiffness_beside_an_overlap_target_is_refused) {
  try {
    (void)test::linear_law("stiffness = 1e4\noverlap_target = 0.01", {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string{error.what()}.find("stiffness"), std::string::npos);
    EXPECT_NE(std::string{error.what()}.find("keep one"), std::string::npos);
  }
}

TEST(linear_settings, the_stable_step_is_a_twentieth_of_the_contact_time) {
  const auto law = test::linear_law("stiffness = 1e4", {.restitution = 1.0});
  const double mass = 1e-5;
  EXPECT_NEAR(law->stable_step({.mass = mass, .radius = 1e-3, .speed = 1.0}),
              std::numbers::pi * std::sqrt(mass / 1e4) / 20.0, 1e-12);
}

// Whatever the springs and dashpots: an impact with the stable step leaves with its restitution, to within a few percent of
// the speed.
TEST(linear_settings, the_stable_step_resolves_impacts_of_any_damping) {
  for (const double e : {1.0, 0.7, 0.3, 0.1, 0.05}) {
    for (const char* along : {"", "\ntangential_stiffness_ratio = 30.0", "\ntangential_damping_ratio = 10.0"}) {
      const auto law = test::linear_law(std::string{"stiffness = 1e4"} + along, {.friction = 0.5, .restitution = e});
      const test::DrivenBall ball{
          .position = {0, 0, 1.00001e-3}, .velocity = {0.2, 0, -1}, .radius = 1e-3, .mass = 1e-5};
      test::ContactDrive drive{*law, ball};
      const double before = drive.kinetic_energy();
      ASSERT_TRUE(drive.run(law->stable_step({.mass = 1e-5, .radius = 1e-3, .speed = 1.0}), 10000));
      EXPECT_NEAR(drive.ball.velocity.z, e, 0.03) << e << along;
      EXPECT_LT(drive.kinetic_energy(), 1.01 * before);
    }
  }
}

// Law: the step limit of velocity Verlet with predicted velocities, by the growth of a free oscillation.
TEST(linear_settings, the_longest_stable_step_is_stable) {
  const auto grows = [](double zeta, double h) {
    double x = 1.0, v = 0.0, old = -1.0;
    for (int count = 0; count < 2000; ++count) {
      v += 0.5 * h * old, x += h * v;
      const double a = -x - 2.0 * zeta * (v + 0.5 * h * old);
      v += 0.5 * h * a, old = a;
    }
    return std::abs(x) > 10.0 || !std::isfinite(x);
  };
  for (const double zeta : {0.0, 0.05, 0.3, 1.0, 3.0}) {
    const double limit = granular::longest_stable_step(1.0, 1.0, 2.0 * zeta);
    EXPECT_FALSE(grows(zeta, 0.99 * limit)) << zeta;
    EXPECT_TRUE(grows(zeta, 1.01 * limit)) << zeta;
  }
}

}  // namespace
}  // namespace scree
