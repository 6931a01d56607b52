// The benchmark of Chung and Ooi, "Benchmark tests for verifying discrete element modelling codes at particle impact level",
// Granular Matter 13 (2011) 643: values within 1 percent, sliding cases by closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "hertz_world.hpp"

namespace scree {
namespace {

using test::ContactDrive;
using test::DrivenBall;
using test::HertzWorld;

constexpr double kPercent = 0.01;

TEST(chung_ooi, test_1_two_glass_spheres) {
  HertzWorld world{"", test::elastic("glass", 48e9, 0.20, 2800, {.friction = 0.35, .restitution = 1.0})};
  DrivenBall a = world.touching(0.01, {0, 0, 10}), b = world.touching(0.01, {0, 0, -10});
  b.position.z += 0.02;
  ContactDrive drive{*world.law, a, b};
  ASSERT_TRUE(drive.run(4e-9));
  EXPECT_NEAR(drive.deepest, 274.1e-6, kPercent * 274.1e-6);
  EXPECT_NEAR(drive.hardest, 10.697e3, kPercent * 10.697e3);
  EXPECT_NEAR(drive.contact_time, 40.34e-6, kPercent * 40.34e-6);
  EXPECT_NEAR(drive.ball.velocity.z, 10.0, 1e-4);
}

TEST(chung_ooi, test_2_a_sphere_of_aluminium_alloy_on_a_rigid_wall) {
  HertzWorld world{"", test::elastic("alloy", 70e9, 0.30, 2699, {.friction = 0.0, .restitution = 1.0})};
  ContactDrive drive = world.on_wall(world.touching(0.1, {0, 0, -0.2}));
  ASSERT_TRUE(drive.run(7e-8));
  EXPECT_NEAR(drive.deepest, 49.72e-6, kPercent * 49.72e-6);
  EXPECT_NEAR(drive.hardest, 11.37e3, kPercent * 11.37e3);
  EXPECT_NEAR(drive.contact_time, 731.7e-6, kPercent * 731.7e-6);
}

// Of two materials of the paper, over all coefficients and both ends of contact.
TEST(chung_ooi, test_3_restitution_out_is_restitution_in) {
  for (const char* end : {"no_tension", "gap"}) {
    for (const double e : {0.2, 0.4, 0.6, 0.8, 0.9, 1.0}) {
      for (const double young : {380e9, 70e9}) {
        HertzWorld world{std::string{"end_of_contact = \""} + end + "\"",
                         test::elastic("ball", young, 0.23, 4000, {.restitution = e})};
        ContactDrive drive = world.on_wall(world.touching(2.5e-3, {0, 0, -3.9}));
        ASSERT_TRUE(drive.run(1e-9));
        EXPECT_NEAR(drive.ball.velocity.z / 3.9, e, 1e-4) << end << " " << young;
      }
    }
  }
}

// Law: at tan th >= 7/2 mu (1 + e) it slides throughout: e_t = 1 - mu (1 + e) / tan th, w = 5/2 mu (1 + e) v cos th / R.
TEST(chung_ooi, test_4_oblique_impacts_of_one_speed) {
  const double mu = 0.092, e = 0.98, r = 2.5e-3, v = 3.9;
  HertzWorld world{"", test::elastic("oxide", 380e9, 0.23, 4000, {.friction = mu, .restitution = e})};
  for (const double degrees : {35.0, 40.0, 50.0, 60.0, 70.0, 80.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    ASSERT_GT(std::tan(angle), 3.5 * mu * (1.0 + e));
    ContactDrive drive = world.on_wall(world.touching(r, {v * std::sin(angle), 0, -v * std::cos(angle)}));
    ASSERT_TRUE(drive.run(2e-9));
    const double w = 2.5 * mu * (1.0 + e) * v * std::cos(angle) / r;
    EXPECT_NEAR(drive.ball.velocity.x / (v * std::sin(angle)), 1.0 - mu * (1.0 + e) / std::tan(angle), kPercent);
    EXPECT_NEAR(drive.ball.spin.y, w, kPercent * w) << degrees;
    EXPECT_NEAR(drive.ball.velocity.z, e * v * std::cos(angle), 1e-3);
  }
}

// Law: with the normal speed kept, the same impulses at any tangential speed that slides.
TEST(chung_ooi, test_5_oblique_impacts_of_one_normal_speed_that_slide) {
  const double mu = 0.3, e = 1.0, r = 1e-2, vn = 0.2;
  HertzWorld world{"", test::elastic("steel", 210e9, 0.3, 7850, {.friction = mu, .restitution = e})};
  for (const double vt : {0.45, 0.8, 2.0}) {
    ContactDrive drive = world.on_wall(world.touching(r, {vt, 0, -vn}));
    ASSERT_TRUE(drive.run(2e-8));
    EXPECT_NEAR(drive.ball.velocity.x, vt - mu * (1.0 + e) * vn, kPercent * vt);
    EXPECT_NEAR(drive.ball.spin.y * r, 2.5 * mu * (1.0 + e) * vn, kPercent * 2.5 * mu * (1.0 + e) * vn);
  }
}

// Law: a spin alone: the wall takes 5/2 mu (1 + e) v_n / R of it and throws the ball sideways with mu (1 + e) v_n.
TEST(chung_ooi, test_6_spinning_impacts_on_a_wall_that_slide) {
  const double mu = 0.4, e = 0.5, r = 0.1, vn = 0.2;
  HertzWorld world{"", test::elastic("alloy", 70e9, 0.33, 2700, {.friction = mu, .restitution = e})};
  for (const double spin : {5.0, 20.0}) {
    DrivenBall ball = world.touching(r, {0, 0, -vn});
    ball.spin.y = -spin;
    ASSERT_GT(spin * r, 3.5 * mu * (1.0 + e) * vn);
    ContactDrive drive = world.on_wall(ball);
    ASSERT_TRUE(drive.run(1e-7));
    EXPECT_NEAR(drive.ball.velocity.x, -mu * (1.0 + e) * vn, kPercent * mu * (1.0 + e) * vn);
    EXPECT_NEAR(drive.ball.spin.y, -spin + 2.5 * mu * (1.0 + e) * vn / r, kPercent * 2.5 * mu * (1.0 + e) * vn / r);
  }
}

// Laws of tests 7 and 8, two spheres of equal and of different size that spin alike: the impulse is mu (1 + e) m 2 v with the
// effective mass m, its moment the radius of each.
TEST(chung_ooi, tests_7_and_8_spinning_impacts_of_two_spheres_that_slide) {
  const double mu = 0.4, e = 0.5, vn = 0.2, spin = 30.0, ra = 0.1;
  for (const double rb : {0.1, 0.05}) {
    HertzWorld world{"", test::elastic("alloy", 70e9, 0.33, 2700, {.friction = mu, .restitution = e})};
    DrivenBall a = world.touching(ra, {0, 0, vn}), b = world.touching(rb, {0, 0, -vn});
    b.position.z = 2.0 * ra + rb;
    a.spin.y = b.spin.y = spin;
    ContactDrive drive{*world.law, a, b};
    ASSERT_TRUE(drive.run(5e-8));
    const double impulse = mu * (1.0 + e) * 2.0 * vn * a.mass * b.mass / (a.mass + b.mass);
    // At b's lower side the surface of b moves with -w R, that of a with + w R, along x: b is pushed to +x.
    EXPECT_NEAR(drive.ball.velocity.x, impulse / b.mass, kPercent * impulse / b.mass);
    EXPECT_NEAR(drive.other->velocity.x, -impulse / a.mass, kPercent * impulse / a.mass);
    EXPECT_NEAR(drive.ball.spin.y, spin - 2.5 * impulse / (b.mass * rb), kPercent * 2.5 * impulse / (b.mass * rb));
    EXPECT_NEAR(drive.other->spin.y, spin - 2.5 * impulse / (a.mass * ra), kPercent * 2.5 * impulse / (a.mass * ra));
  }
}

// Tests 5 to 8 where the surfaces grip, with a dashpot that stops them: the ball rolls away.
TEST(chung_ooi, tests_5_and_6_with_much_friction_end_in_rolling) {
  const double r = 1e-2;
  HertzWorld world{"tangential_damping = 500.0",
                   test::elastic("steel", 210e9, 0.3, 7850, {.friction = 1e6, .restitution = 0.6})};
  for (const double spin : {0.0, 10.0, -25.0}) {
    DrivenBall ball = world.touching(r, {0.1, 0, -0.2});
    ball.spin.y = spin;
    ContactDrive drive = world.on_wall(ball);
    ASSERT_TRUE(drive.run(1e-9));
    const double rolling = 5.0 / 7.0 * 0.1 + 2.0 / 7.0 * spin * r;
    EXPECT_NEAR(drive.ball.velocity.x, rolling, kPercent * 0.1);
    EXPECT_NEAR(drive.ball.spin.y * r, rolling, kPercent * 0.25);
  }
}

}  // namespace
}  // namespace scree
