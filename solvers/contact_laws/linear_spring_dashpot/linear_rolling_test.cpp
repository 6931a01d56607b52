// Rolling resistance and cohesion with the linear law: a ball on a floor.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "linear_world.hpp"

namespace scree {
namespace {

using test::ContactDrive;
using test::DrivenBall;

constexpr double kRadius = 0.01, kMass = 0.01, kG = 9.81, kArm = 5e-4, kStiffness = 1e5, kStep = 2e-5;
const std::string kLaw = "stiffness = 1e5\n";
constexpr ContactMaterial kRubber{
    .friction = 0.6, .restitution = 0.3, .rolling_friction = kArm, .spinning_friction = 0.25 * kArm};

DrivenBall lying() { return {.position = {0, 0, kRadius - kMass * kG / kStiffness}, .radius = kRadius, .mass = kMass}; }

void run(ContactDrive& drive, double duration) {
  for (const double end = drive.time + duration; drive.time < end;) drive.step(kStep);
}

// Law: a = -5/7 rho g / R, for both models while the ball rolls.
TEST(linear_rolling, slows_a_ball_down_by_the_moment_of_its_arm) {
  for (const char* model : {"constant_directional", "elastic_plastic"}) {
    const auto law = test::linear_law(kLaw + "rolling = \"" + model + "\"", kRubber);
    ContactDrive drive{*law, lying()};
    drive.gravity = {0, 0, -kG};
    drive.ball.velocity.x = 0.5, drive.ball.spin.y = 0.5 / kRadius;
    run(drive, 0.5);
    // The elastic model yields after rho load / k = 4e-4 rad, and the grip of the tangential spring needs its first moment.
    EXPECT_NEAR(drive.ball.velocity.x, 0.5 - 5.0 / 7.0 * kArm * kG / kRadius * drive.time, 1e-3) << model;
    EXPECT_NEAR(drive.ball.spin.y * kRadius, drive.ball.velocity.x, 2e-4);
  }
}

TEST(linear_rolling, of_the_elastic_plastic_model_brings_a_ball_to_rest_where_it_stays) {
  const auto law = test::linear_law(kLaw + "rolling = \"elastic_plastic\"", kRubber);
  ContactDrive drive{*law, lying()};
  drive.gravity = {0, 0, -kG};
  drive.ball.velocity.x = 0.1, drive.ball.spin.y = 0.1 / kRadius;
  run(drive, 1.0);  // it stops after 0.28 s
  const double where = drive.ball.position.x;
  EXPECT_NEAR(where, 0.7 * 0.01 / (kArm * kG / kRadius), 5e-4);  // 7 R v^2 / (10 rho g)
  run(drive, 0.5);
  EXPECT_NEAR(drive.ball.position.x, where, 1e-9 * kRadius);
  EXPECT_LT(std::abs(drive.ball.velocity.x), 1e-9);
}

// Law: it stays on an incline up to tan a = rho / R, and beyond rolls with 5/7 g (sin a - rho / R cos a).
TEST(linear_rolling, holds_a_ball_on_an_incline_up_to_its_angle) {
  for (const double factor : {0.9, 1.5}) {
    const double angle = std::atan(factor * kArm / kRadius);
    const auto law = test::linear_law(kLaw + "rolling = \"elastic_plastic\"", kRubber);
    ContactDrive drive{*law, lying()};
    drive.gravity = {kG * std::sin(angle), 0, -kG * std::cos(angle)};
    run(drive, 0.5);
    const double a = 5.0 / 7.0 * kG * (std::sin(angle) - kArm / kRadius * std::cos(angle));
    EXPECT_NEAR(drive.ball.velocity.x, factor < 1.0 ? 0.0 : a * drive.time, factor < 1.0 ? 1e-8 : 0.01 * a);
  }
}

// Law: a spin w about the normal stops after 2 R^2 w / (5 rho g).
TEST(linear_rolling, stops_a_spinning_ball) {
  for (const char* model : {"constant_directional", "elastic_plastic"}) {
    const auto law = test::linear_law(kLaw + "spinning = \"" + model + "\"", kRubber);
    ContactDrive drive{*law, lying()};
    drive.gravity = {0, 0, -kG};
    drive.ball.spin.z = 10.0;
    const double slows = 2.5 * 0.25 * kArm * kG / (kRadius * kRadius);  // [rad/s2]
    run(drive, 0.5 * 10.0 / slows);
    EXPECT_NEAR(drive.ball.spin.z, 5.0, 0.01) << model;
    EXPECT_NEAR(norm(drive.ball.velocity), 0.0, 1e-9);
    run(drive, 10.0 / slows + 1.0);  // the elastic one swings with sqrt(k / I) = 94 rad/s, damped with a ratio of 0.3
    // A constant moment swings about zero by what it does in two steps.
    EXPECT_NEAR(drive.ball.spin.z, 0.0, model[0] == 'c' ? 2.0 * slows * kStep : 1e-8);
  }
}

// Force and friction of a contact with an overlap, at rest but for a fast slip along x.
struct Pulled {
  explicit Pulled(const ContactLaw& law, double overlap) {
    batch.count = 1;
    batch.overlap[0] = overlap, batch.radius[0] = kRadius, batch.mass[0] = kMass;
    batch.normal.set(0, {0, 0, 1});
    batch.velocity.set(0, {1e3, 0, 0});
    batch.spin.set(0, {});
    batch.materials[0] = 0;
    batch.ahead[0] = batch.lead = 1e-3;
    law.forces(batch);
  }
  ContactBatch batch{};
};

TEST(linear_cohesion, of_an_energy_density_attracts_by_the_area_of_contact) {
  const auto law = test::linear_law(kLaw + "cohesion = \"sced\"", {.friction = 0.6, .cohesion_energy_density = 1e5});
  const Pulled contact{*law, 1e-4};
  EXPECT_NEAR(contact.batch.force.z[0], kStiffness * 1e-4 - 1e5 * 2.0 * std::numbers::pi * kRadius * 1e-4, 1e-12);
  EXPECT_NEAR(contact.batch.force.x[0], -0.6 * kStiffness * 1e-4, 1e-12) << "attraction presses the surfaces together";
  EXPECT_TRUE(law->coheres());
}

TEST(linear_cohesion, of_a_surface_energy_lets_go_at_the_force_of_derjaguin) {
  const auto law = test::linear_law(kLaw + "cohesion = \"dmt\"", {.friction = 0.6, .surface_energy = 0.05});
  const double pull_off = 2.0 * std::numbers::pi * 0.05 * kRadius;
  EXPECT_NEAR(Pulled(*law, 0.0).batch.force.z[0], -pull_off, 1e-15);
  const Pulled contact{*law, 1e-6};
  EXPECT_NEAR(contact.batch.force.z[0], kStiffness * 1e-6 - pull_off, 1e-15);
  EXPECT_NEAR(contact.batch.force.x[0], -0.6 * kStiffness * 1e-6, 1e-12);
  EXPECT_EQ(Pulled(*law, -1e-9).batch.force[0], Vec3{}) << "nothing reaches beyond the surfaces";
}

}  // namespace
}  // namespace scree
