// Friction of dvi: sliding to rolling, inclines, and the gap of the associated problem.
#include "dvi_world.hpp"

#include <gtest/gtest.h>

#include <random>

namespace scree::test {
namespace {

constexpr double kG = 9.81;

DviOptions exact() { return {.coulomb = true, .coulomb_limits = {.tolerance = 1e-12, .max_solves = 100}}; }

// v = 5/7 v0 once it rolls, at t = 2 v0 / (7 mu g), whatever the step: friction's arm is the radius as long as the
// sphere does not leave the floor.
TEST(dvi_coulomb, sliding_sphere_ends_rolling_at_five_sevenths_of_its_speed_for_any_step) {
  const double v0 = 1.0, mu = 0.3;
  for (const double h : {1e-2, 3e-3, 1e-3}) {
    World w{exact()};
    w.host.material({.friction = mu});
    const std::size_t i = w.add_sphere({0, 0, 0.05}, 0.05, 1000.0, {v0, 0, 0});
    while (w.time < 0.3) w.step(h);
    EXPECT_NEAR(w.bodies.velocity[i].x, 5.0 / 7.0 * v0, 1e-10) << h;
    EXPECT_NEAR(w.bodies.angular_velocity[i].y * 0.05, 5.0 / 7.0 * v0, 1e-10) << h;
    // It slides for 2 v0 / (7 mu g) and goes 12 v0^2 / (49 mu g) meanwhile; position lags by half a step.
    const double slide = 2 * v0 / (7 * mu * kG);
    const double x = 12 * v0 * v0 / (49 * mu * kG) + 5.0 / 7.0 * v0 * (w.time - slide);
    EXPECT_NEAR(w.bodies.position[i].x, x, h * v0);
    EXPECT_NEAR(w.bodies.position[i].z, 0.05, 1e-10);
  }
}

// Spinless block: a body so hard to turn that it slides.
std::size_t add_block(World& w, const Vec3& velocity) {
  const double infinite = 1e12;
  return w.bodies.add(1, Motion::dynamic, {0, 0, 0.05}, 0.05, 1.0, {infinite, infinite, infinite}, velocity);
}

// The associated problem wants Phi / h + u_n = mu |u_t| where it slides: it floats at that gap, which shrinks with the
// speed. A block that starts on the floor is thrown up to it, and flies on: start there.
TEST(dvi, sliding_contact_floats_at_mu_h_u) {
  const double mu = 0.3, h = 1e-3;
  World w;
  w.host.material({.friction = mu});
  const std::size_t i = add_block(w, {5, 0, 0});
  w.bodies.position[i].z += mu * h * 5;
  for (int k = 0; k < 50; ++k) {
    w.step(h);
    const double speed = w.bodies.velocity[i].x;
    EXPECT_NEAR(w.bodies.position[i].z - 0.05, mu * h * speed, 1e-12);
  }
}

TEST(dvi_coulomb, sliding_contact_does_not_float) {
  World w{exact()};
  w.host.material({.friction = 0.3});
  const std::size_t i = add_block(w, {5, 0, 0});
  const double h = 1e-3;
  w.run(50, h);
  EXPECT_NEAR(w.bodies.position[i].z, 0.05, 1e-12);
  EXPECT_NEAR(w.bodies.velocity[i].x, 5 - 0.3 * kG * 50 * h, 1e-10);
}

TEST(dvi_coulomb, reports_its_solves_and_its_error) {
  World w{DviOptions{.coulomb = true, .coulomb_limits = {.tolerance = 1e-6, .max_solves = 50}}};
  w.host.material({.friction = 0.3});
  add_block(w, {5, 0, 0});
  const int before = w.host.solves;
  const StepSummary s = w.step(1e-3);
  EXPECT_EQ(s.friction_solves, w.host.solves - before);
  EXPECT_GE(s.friction_solves, 1);
  EXPECT_LE(s.friction_error, 1e-6);
  EXPECT_EQ(s.solve.status, SolveStatus::converged);
}

// A block on an incline stays iff mu >= tan a; gravity is tilted in place of the floor.
TEST(dvi, block_sticks_on_an_incline_up_to_the_friction_angle) {
  const double mu = 0.5, angle = std::atan(mu);
  for (const bool coulomb : {false, true}) {
    for (const double turn : {-0.01, 0.01}) {
      World w{coulomb ? exact() : DviOptions{}};
      w.host.material({.friction = mu});
      w.host.gravity = {kG * std::sin(angle + turn), 0, -kG * std::cos(angle + turn)};
      const std::size_t i = add_block(w, {});
      w.run(200, 1e-3);
      const double v = w.bodies.velocity[i].x;
      if (turn < 0) {
        EXPECT_NEAR(v, 0.0, 1e-10);
      } else {
        // Slides at g (sin - mu cos); the associated problem's normal velocity takes a little (second order in mu h).
        const double a = kG * (std::sin(angle + turn) - mu * std::cos(angle + turn));
        EXPECT_NEAR(v, a * 0.2, coulomb ? 1e-9 : 0.05 * a * 0.2);
      }
    }
  }
}

// A solid sphere rolls down at 5/7 g sin a iff mu >= 2/7 tan a.
TEST(dvi, sphere_rolls_down_an_incline_at_five_sevenths) {
  const double angle = 0.4;
  World w;
  w.host.material({.friction = 1.05 * 2.0 / 7.0 * std::tan(angle)});
  w.host.gravity = {kG * std::sin(angle), 0, -kG * std::cos(angle)};
  const std::size_t i = w.add_sphere({0, 0, 0.05}, 0.05);
  w.run(500, 1e-3);
  EXPECT_NEAR(w.bodies.velocity[i].x, 5.0 / 7.0 * kG * std::sin(angle) * 0.5, 1e-9);
}

TEST(dvi_coulomb, sphere_slips_below_the_friction_that_rolling_needs) {
  const double angle = 0.4, mu = 0.9 * 2.0 / 7.0 * std::tan(angle);
  World w{exact()};
  w.host.material({.friction = mu});
  w.host.gravity = {kG * std::sin(angle), 0, -kG * std::cos(angle)};
  const std::size_t i = w.add_sphere({0, 0, 0.05}, 0.05);
  w.run(500, 1e-3);
  EXPECT_NEAR(w.bodies.velocity[i].x, kG * (std::sin(angle) - mu * std::cos(angle)) * 0.5, 1e-9);
  EXPECT_NEAR(w.bodies.angular_velocity[i].y * 0.05, 2.5 * mu * kG * std::cos(angle) * 0.5, 1e-9);
}

// Spheres piled at random, pushed: the fixed point must end, and say what it reached.
TEST(dvi_coulomb, pile_meets_the_coulomb_conditions_to_the_error_it_reports) {
  World w{DviOptions{.coulomb = true, .coulomb_limits = {.tolerance = 1e-5, .max_solves = 200}}};
  std::mt19937_64 random{4};
  std::uniform_real_distribution<double> u{-0.004, 0.004};
  for (int k = 0; k < 18; ++k) {
    const int layer = k / 9;
    w.add_sphere({0.099 * (k % 3) + u(random), 0.099 * (k / 3 % 3) + u(random), 0.05 + 0.099 * layer}, 0.05, 1000.0,
                 {0.5, 0, 0});
  }
  w.host.material({.friction = 0.5});
  w.host.tolerance = 1e-9;
  for (int k = 0; k < 10; ++k) {
    const StepSummary s = w.step(1e-3);
    EXPECT_LE(s.friction_error, 1e-5);
    const ContactView c = w.dvi.contacts();
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Vec3 g = c.impulse[i], v = c.velocity_after[i];
      EXPECT_LE(std::hypot(g.y, g.z), 0.5 * g.x + 1e-12);
      // Maximum dissipation: where it slides, friction is at its limit and against the slip.
      const double slip = std::hypot(v.y, v.z);
      EXPECT_NEAR(g.y * v.y + g.z * v.z, -0.5 * g.x * slip, 2e-4 * g.x);
    }
  }
}

}  // namespace
}  // namespace scree::test
