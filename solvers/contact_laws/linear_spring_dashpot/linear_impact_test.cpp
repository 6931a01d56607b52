// Head-on impacts with a linear spring and dashpot, against the damped oscillator.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "linear_world.hpp"

namespace scree {
namespace {

using test::ContactDrive;
using test::DrivenBall;

constexpr double kRadius = 1e-3, kMass = 1e-5, kStiffness = 1e4, kSpeed = 0.5;
const double kRate = std::sqrt(kStiffness / kMass);

DrivenBall falling(double above = 0.0) {
  return {.position = {0, 0, kRadius + above}, .velocity = {0, 0, -kSpeed}, .radius = kRadius, .mass = kMass};
}

const std::string kGap = "stiffness = 1e4\nend_of_contact = \"gap\"", kNoTension = "stiffness = 1e4";

// zeta by the closed form of each end, the other one inverted by halving.
double ratio_until_the_gap_is_zero(double e) { return -std::log(e) / std::hypot(std::numbers::pi, std::log(e)); }
double ratio_without_tension(double e) {
  double low = 0.0, high = 1.0;
  for (int round = 0; round < 60; ++round) {
    const double zeta = 0.5 * (low + high), root = std::sqrt(1.0 - zeta * zeta);
    const double of = std::exp(-zeta / root * std::atan2(2.0 * zeta * root, 2.0 * zeta * zeta - 1.0));
    (of > e ? low : high) = zeta;
  }
  return low;
}

TEST(linear_impact, leaves_with_its_restitution_at_either_end_of_contact) {
  for (const std::string& toml : {kGap, kNoTension}) {
    for (const double e : {1.0, 0.9, 0.5, 0.2}) {
      const auto law = test::linear_law(toml, {.restitution = e});
      ContactDrive drive{*law, falling()};
      ASSERT_TRUE(drive.run(1e-8));
      // About (h w0)^2 = 1e-7 at 10 000 steps.
      EXPECT_NEAR(drive.ball.velocity.z / kSpeed, e, 1e-6) << toml;
    }
  }
}

TEST(linear_impact, without_tension_leaves_with_a_restitution_below_that_of_critical_damping) {
  const auto law = test::linear_law(kNoTension, {.restitution = 0.08});
  ContactDrive drive{*law, falling()};
  ASSERT_TRUE(drive.run(1e-9));
  EXPECT_NEAR(drive.ball.velocity.z / kSpeed, 0.08, 1e-6);
}

TEST(linear_impact, lasts_and_reaches_as_deep_as_a_damped_oscillator) {
  for (const double e : {1.0, 0.7, 0.3}) {
    for (const bool gap : {true, false}) {
      const double zeta = gap ? ratio_until_the_gap_is_zero(e) : ratio_without_tension(e);
      const double root = std::sqrt(1.0 - zeta * zeta);
      const auto law = test::linear_law(gap ? kGap : kNoTension, {.restitution = e});
      ContactDrive drive{*law, falling()};
      ASSERT_TRUE(drive.run(1e-8));
      EXPECT_NEAR(drive.deepest, kSpeed / kRate * std::exp(-zeta / root * std::acos(zeta)), 1e-6 * kSpeed / kRate);
      if (gap) {
        EXPECT_NEAR(drive.contact_time, std::numbers::pi / (kRate * root), 2e-8);  // to the step
      }
      EXPECT_EQ(drive.weakest < -1e-3 * drive.hardest, gap && e < 1.0)
          << "only a dashpot pulls, and only until the gap closes";
    }
  }
}

// Law: errors fall with the square of the step, wherever in a step the surfaces meet and part.
TEST(linear_impact, converges_with_the_second_order_of_the_step) {
  for (const std::string& toml : {kGap, kNoTension}) {
    const auto law = test::linear_law(toml, {.restitution = 0.7});
    const auto worst = [&](int steps) {
      const double h = std::numbers::pi / kRate / steps;
      double error = 0.0;
      for (int phase = 0; phase < 16; ++phase) {
        ContactDrive drive{*law, falling(phase / 16.0 * h * kSpeed)};
        EXPECT_TRUE(drive.run(h));
        error = std::max(error, std::abs(drive.ball.velocity.z / kSpeed - 0.7));
      }
      return error;
    };
    const double coarse = worst(40), fine = worst(640);
    EXPECT_GT(std::log2(coarse / fine) / 4.0, 1.75) << toml << ": " << coarse << " and " << fine;
    EXPECT_LT(coarse, 0.01);
  }
}

TEST(linear_impact, of_two_balls_conserves_momentum_and_separates_with_its_restitution) {
  const auto law = test::linear_law(kNoTension, {.restitution = 0.6});
  const DrivenBall a{.velocity = {0, 0, 0.3}, .radius = 2e-3, .mass = 8e-5};
  ContactDrive drive{*law, a, falling()};
  drive.ball.position.z = 3e-3;
  const double before = a.mass * a.velocity.z + kMass * drive.ball.velocity.z;
  ASSERT_TRUE(drive.run(1e-8));
  EXPECT_NEAR(drive.ball.velocity.z - drive.other->velocity.z, 0.6 * 0.8, 1e-6);
  EXPECT_NEAR(a.mass * drive.other->velocity.z + kMass * drive.ball.velocity.z, before, 1e-14);
}

TEST(linear_impact, of_an_elastic_spring_keeps_the_energy) {
  const auto law = test::linear_law(kNoTension, {.restitution = 1.0});
  ContactDrive drive{*law, falling()};
  const double whole = drive.kinetic_energy();
  for (int count = 0; count < 3000; ++count) {
    drive.step(1e-8);
    // The velocity at hand is predicted to first order of the step: h k x / (2 m v).
    EXPECT_NEAR(drive.kinetic_energy() + 0.5 * kStiffness * drive.overlap * drive.overlap, whole, 1e-3 * whole);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(linear_impact, at_the_stated_speed_reaches_the_stated_part_of_the_radius) {
  const auto law = test::linear_law("overlap_target = 0.02\noverlap_speed = 0.5", {.restitution = 1.0});
  for (const double size : {1.0, 3.0}) {
    DrivenBall ball = falling();
    ball.radius *= size, ball.position.z *= size, ball.mass *= size * size * size;
    ContactDrive drive{*law, ball};
    ASSERT_TRUE(drive.run(1e-8));
    EXPECT_NEAR(drive.deepest / ball.radius, 0.02, 1e-6);
  }
}

TEST(linear_impact, of_a_compliant_pair_has_its_own_stiffness_and_damping) {
  const double c = 0.03;
  const auto law = test::linear_law("overlap_target = 0.02\nend_of_contact = \"gap\"",
                                    {.restitution = 0.9, .compliance = 0.5 / kStiffness, .damping = c});
  ContactDrive drive{*law, falling()};  // of one material: compliances add
  ASSERT_TRUE(drive.run(1e-8));
  const double zeta = 0.5 * c / std::sqrt(kStiffness * kMass);
  EXPECT_NEAR(drive.ball.velocity.z / kSpeed, std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta)), 1e-6);
}

}  // namespace
}  // namespace scree
