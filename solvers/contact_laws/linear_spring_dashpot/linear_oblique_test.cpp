// Oblique impacts of a ball on a floor, with a linear spring and dashpot along both directions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "linear_world.hpp"

namespace scree {
namespace {

using test::ContactDrive;
using test::DrivenBall;

constexpr double kRadius = 1e-3;
const double kMass = 2500.0 * 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;

DrivenBall falling(double vx, double vz, double spin = 0.0) {
  return {
      .position = {0, 0, kRadius}, .velocity = {vx, 0, -vz}, .spin = {0, spin, 0}, .radius = kRadius, .mass = kMass};
}

constexpr double kHalf = std::numbers::sqrt2 / 2.0;
const std::string kSprings = "stiffness = 1e4\ntangential_stiffness_ratio = 1.0\ntangential_damping_ratio = 1.0\n";

void expect(const ContactDrive& drive, double up, double along, double surface) {
  EXPECT_NEAR(drive.ball.velocity.z, up, 1e-6);
  EXPECT_NEAR(drive.ball.velocity.x, along, 1e-6);
  EXPECT_NEAR(-drive.ball.spin.y * kRadius, surface, 3e-6);  // R w' is 5/2 of what u' changed by
}

// An independent integration of the same equations gave u' and R w' to six digits.
TEST(linear_oblique_impact, until_the_gap_is_zero_has_the_velocities_of_an_independent_integration) {
  const auto law = test::linear_law(kSprings + "end_of_contact = \"gap\"", {.friction = 0.3, .restitution = 0.7});
  ContactDrive drive{*law, falling(kHalf, kHalf)};
  ASSERT_TRUE(drive.run(1e-9));
  expect(drive, 0.7 * kHalf, 0.468103, -0.597510);
}

TEST(linear_oblique_impact, without_friction_in_the_tensile_tail_has_those_of_the_other) {
  const auto law = test::linear_law(kSprings + "end_of_contact = \"gap\"\nfriction_in_tension = false",
                                    {.friction = 0.3, .restitution = 0.7});
  ContactDrive drive{*law, falling(kHalf, kHalf)};
  ASSERT_TRUE(drive.run(1e-9));
  expect(drive, 0.7 * kHalf, 0.464706, -0.606001);
}

// With the same dashpot, what a contact without tension leaves out is only the tail along the normal.
TEST(linear_oblique_impact, without_tension_has_the_same_along_the_floor_for_the_same_dashpot) {
  const double zeta = -std::log(0.7) / std::hypot(std::numbers::pi, std::log(0.7));
  const auto law = test::linear_law(
      kSprings + "damping = " + std::to_string(2e6 * zeta * std::sqrt(1e4 * kMass)) + "e-6", {.friction = 0.3});
  ContactDrive drive{*law, falling(kHalf, kHalf)};
  ASSERT_TRUE(drive.run(1e-9));
  const double root = std::sqrt(1.0 - zeta * zeta);
  const double e = std::exp(-zeta / root * std::atan2(2.0 * zeta * root, 2.0 * zeta * zeta - 1.0));
  expect(drive, e * kHalf, 0.464706, -0.606001);
}

// Law: while it slides throughout, tan(angle) >= 7/2 mu (1 + e), a ball loses mu (1 + e) v_n along the floor and takes up the
// spin 5/2 mu (1 + e) v_n / R.
TEST(linear_oblique_impact, at_shallow_angles_slides_by_the_closed_form) {
  const double mu = 0.1, e = 0.8;
  const auto law = test::linear_law(kSprings, {.friction = mu, .restitution = e});
  for (const double tangent : {3.5 * mu * (1.0 + e) * 1.1, 2.0, 5.0}) {
    ContactDrive drive{*law, falling(tangent, 1.0)};
    ASSERT_TRUE(drive.run(2e-8));
    // The last thousandth of the impact: Coulomb's limit falls to zero with the normal force, the spring with it.
    EXPECT_NEAR(drive.ball.velocity.x, tangent - mu * (1.0 + e), 1e-5);
    EXPECT_NEAR(-drive.ball.spin.y * kRadius, -2.5 * mu * (1.0 + e), 3e-5);
  }
}

// Law: with kt = 2/7 k and friction enough, the surface swings back as the normal does: u' = -u for e = 1.
TEST(linear_oblique_impact, that_sticks_turns_the_velocity_of_the_surface_round) {
  const auto law = test::linear_law("stiffness = 1e4", {.friction = 100.0, .restitution = 1.0});
  for (const double spin : {0.0, 300.0, -500.0}) {
    ContactDrive drive{*law, falling(0.4, 1.0, spin)};
    const double before = 0.4 - spin * kRadius;
    ASSERT_TRUE(drive.run(1e-8));
    const double after = drive.ball.velocity.x - drive.ball.spin.y * kRadius;
    EXPECT_NEAR(after, -before, 1e-5);
    EXPECT_NEAR(drive.ball.velocity.x, 0.4 - 2.0 * 2.0 / 7.0 * before, 1e-5);  // impulse 2 m_t u, m_t = 2/7 m
  }
}

// Law: a surface that a strong dashpot alone stops rolls away, with 5/7 of what it came with and 2/7 of its spin.
TEST(linear_oblique_impact, that_a_dashpot_brings_to_rolling_rolls) {
  const auto law =
      test::linear_law("stiffness = 1e4\ntangential_stiffness_ratio = 0.0\ntangential_damping_ratio = 20.0",
                       {.friction = 100.0, .restitution = 0.5});
  ContactDrive drive{*law, falling(0.4, 1.0, 300.0)};
  ASSERT_TRUE(drive.run(2e-9));
  EXPECT_NEAR(drive.ball.velocity.x, 5.0 / 7.0 * 0.4 + 2.0 / 7.0 * 300.0 * kRadius, 1e-6);
  EXPECT_NEAR(drive.ball.spin.y * kRadius, drive.ball.velocity.x, 1e-6);
}

// Law: two equal balls that spin alike meet head on; their surfaces slide past each other at 2 w R, and each loses the spin
// 5/2 mu (1 + e) v / R, v half of the speed at which they approach.
TEST(linear_oblique_impact, of_two_spinning_balls_slides_by_the_closed_form) {
  const double mu = 0.2, e = 0.9, spin = 3000.0, v = 0.5;
  const auto law = test::linear_law("stiffness = 1e8", {.friction = mu, .restitution = e});  // the normal stays
  const DrivenBall a{
      .position = {0, 0, 0}, .velocity = {0, 0, v}, .spin = {0, spin, 0}, .radius = kRadius, .mass = kMass};
  DrivenBall b = a;
  b.position.z = 2.0 * kRadius, b.velocity.z = -v;
  ContactDrive drive{*law, a, b};
  ASSERT_TRUE(drive.run(1e-10));
  EXPECT_NEAR(drive.ball.spin.y * kRadius, spin * kRadius - 2.5 * mu * (1.0 + e) * v, 3e-5);
  EXPECT_NEAR(drive.ball.velocity.x, mu * (1.0 + e) * v, 3e-5);
  EXPECT_NEAR(drive.other->velocity.x, -mu * (1.0 + e) * v, 3e-5);
  EXPECT_NEAR(drive.other->spin.y, drive.ball.spin.y, 1e-9 * spin);
}

}  // namespace
}  // namespace scree
