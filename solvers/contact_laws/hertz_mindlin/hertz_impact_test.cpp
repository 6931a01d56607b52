// Head-on impacts of elastic spheres, against Hertz' theory.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "hertz_world.hpp"

namespace scree {
namespace {

using test::ContactDrive;
using test::HertzWorld;

constexpr double kRadius = 5e-3, kYoung = 1e9, kPoisson = 0.3;

Material plastic(double e) { return test::elastic("plastic", kYoung, kPoisson, 1200, {.restitution = e}); }
double wall_modulus() { return kYoung / (1.0 - kPoisson * kPoisson); }

// Landau and Lifshitz, Theory of Elasticity, paragraph 9: x = (15 m v^2 / (16 E sqrt(R)))^(2/5), and a time of
// 2 sqrt(pi) Gamma(7/5) / Gamma(9/10) x / v = 2.943 x / v.
TEST(hertz_impact, has_the_depth_force_and_time_of_hertz) {
  HertzWorld world{"", plastic(1.0)};
  for (const double v : {0.1, 1.0, 5.0}) {
    const double m = world.mass(kRadius);
    const double x = std::pow(15.0 * m * v * v / (16.0 * wall_modulus() * std::sqrt(kRadius)), 0.4);
    const double time = 2.0 * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9) * x / v;
    ContactDrive drive = world.on_wall(world.touching(kRadius, {0, 0, -v}));
    ASSERT_TRUE(drive.run(time / 20000));
    EXPECT_NEAR(drive.deepest / x, 1.0, 1e-6);
    EXPECT_NEAR(drive.hardest / (4.0 / 3.0 * wall_modulus() * std::sqrt(kRadius) * std::pow(x, 1.5)), 1.0, 1e-6);
    EXPECT_NEAR(drive.contact_time / time, 1.0, 1e-4);  // to the step
    EXPECT_NEAR(drive.ball.velocity.z / v, 1.0, 1e-6);
  }
}

TEST(hertz_impact, has_a_restitution_that_does_not_depend_on_the_speed) {
  for (const char* end : {"no_tension", "gap"}) {
    for (const double e : {0.9, 0.5, 0.1}) {
      HertzWorld world{std::string{"end_of_contact = \""} + end + "\"", plastic(e)};
      for (const double v : {0.01, 1.0, 30.0}) {
        const double x =
            std::pow(15.0 * world.mass(kRadius) * v * v / (16.0 * wall_modulus() * std::sqrt(kRadius)), 0.4);
        ContactDrive drive = world.on_wall(world.touching(kRadius, {0, 0, -v}));
        ASSERT_TRUE(drive.run(x / v / 10000));
        EXPECT_NEAR(drive.ball.velocity.z / v, e, 2e-5) << end << " " << v;
      }
    }
  }
}

// The greatest error of the restitution over where in a step the surfaces meet.
double worst_error(double e, int steps) {
  HertzWorld world{"", plastic(e)};
  const double h = 4e-4 / steps;  // the impact lasts about 80 us
  double error = 0.0;
  for (int phase = 0; phase < 16; ++phase) {
    test::DrivenBall ball = world.touching(kRadius, {0, 0, -1.0});
    ball.position.z += phase / 16.0 * h;
    ContactDrive drive = world.on_wall(ball);
    EXPECT_TRUE(drive.run(h));
    error = std::max(error, std::abs(drive.ball.velocity.z - e));
  }
  return error;
}

// Law: the second order of the step without a dashpot. With it the order 5/4 of quadrature next to the dashpot's x^(1/4).
TEST(hertz_impact, converges_with_the_order_that_its_force_allows) {
  for (const auto& [e, order] : {std::pair{1.0, 1.75}, std::pair{0.7, 1.15}}) {
    const double coarse = worst_error(e, 200), fine = worst_error(e, 3200);
    EXPECT_GT(std::log2(coarse / fine) / 4.0, order) << coarse << " and " << fine;
    EXPECT_LT(coarse, 0.01);
  }
}

TEST(hertz_impact, of_an_elastic_ball_keeps_the_energy) {
  HertzWorld world{"", plastic(1.0)};
  ContactDrive drive = world.on_wall(world.touching(kRadius, {0, 0, -1.0}));
  const double whole = drive.kinetic_energy();
  do {
    drive.step(1e-8);
    const double spring =
        8.0 / 15.0 * wall_modulus() * std::sqrt(kRadius) * std::pow(std::max(drive.overlap, 0.0), 2.5);
    // The velocity at hand is predicted to first order of the step.
    ASSERT_NEAR(drive.kinetic_energy() + spring, whole, 2e-3 * whole);
  } while (drive.touching());
  EXPECT_NEAR(drive.kinetic_energy(), whole, 1e-5 * whole);
}

}  // namespace
}  // namespace scree
