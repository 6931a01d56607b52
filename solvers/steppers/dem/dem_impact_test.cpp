// Impacts against closed forms, and how the error goes with the sub-step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem_world.hpp"

namespace scree {
namespace {

using test::DemWorld;

constexpr double kRadius = 0.01, kSpeed = 0.5;  // [m], [m/s]

/// Two equal balls `gap` [m] apart meet head on at +-kSpeed/2; returns their speed of separation over that of approach.
double restitution_of(double damping_ratio, double sub_step, double gap, double& most_overlap, double outer = 2e-5) {
  DemWorld world{{.sub_step = sub_step, .force_step = true}};
  const std::size_t a = world.add_ball({-kRadius - 0.5 * gap, 0, 0}, kRadius, {0.5 * kSpeed, 0, 0});
  const std::size_t b = world.add_ball({kRadius + 0.5 * gap, 0, 0}, kRadius, {-0.5 * kSpeed, 0, 0});
  const double mass = 0.5 * world.bodies.mass[a];
  world.law.damping = 2.0 * damping_ratio * std::sqrt(world.law.stiffness * mass);
  most_overlap = 0.0;
  for (double t = 0.0; t < 3e-3; t += outer) {
    world.step(outer);
    most_overlap = std::max(most_overlap, 2.0 * kRadius - (world.bodies.position[b].x - world.bodies.position[a].x));
  }
  return (world.bodies.velocity[b].x - world.bodies.velocity[a].x) / kSpeed;
}

TEST(dem, restitution_of_spring_and_dashpot_converges_with_second_order) {
  // e = exp(-pi zeta / sqrt(1 - zeta^2)). The dashpot's force jumps when the surfaces meet and when they part, at any moment
  // of a sub-step: the greatest error over several such moments counts.
  const double zeta = 0.2, exact = std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
  const auto error_of = [&](double h) {
    double most = 0.0, overlap = 0.0;
    for (int k = 0; k < 16; ++k) {
      most = std::max(most, std::abs(restitution_of(zeta, h, 1e-6 + h * kSpeed * k / 16.0, overlap) - exact));
    }
    return most;
  };
  // 200, 400 and 800 sub-steps an impact; of one with 70, errors of third order take away some of those of the second.
  const double coarse = error_of(7e-6), middle = error_of(3.5e-6), fine = error_of(1.75e-6);
  EXPECT_LT(error_of(2e-5), 3e-4);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_LT(middle, 0.35 * coarse);
  EXPECT_LT(fine, 0.35 * middle);
}

TEST(dem, elastic_impacts_keep_their_energy_at_steps_of_a_twentieth_of_the_contact) {
  // Surfaces meet and part at any moment of a sub-step, and at any place among the outer steps. Nothing may be gained or lost on
  // average; plain velocity Verlet scatters by h^2 w0^2 / 24 = 1e-3.
  const double mass = 0.5 * 1000.0 * 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
  const double h = std::numbers::pi * std::sqrt(mass / 1e4) / 20.0;
  constexpr int kMoments = 40;
  for (const double outer : {7.0 * h, 20.0 * h, 43.0 * h}) {
    double mean = 0.0, overlap = 0.0;
    for (int k = 0; k < kMoments; ++k) {
      const double e = restitution_of(0.0, h, 1e-6 + h * kSpeed * k / kMoments, overlap, outer);
      EXPECT_NEAR(e, 1.0, 5e-3);
      mean += e / kMoments;
    }
    EXPECT_NEAR(mean, 1.0, 5e-4);
  }
}

TEST(dem, greatest_overlap_is_that_of_the_closed_form) {
  // x_max = (v / w0) exp(-zeta acos(zeta) / sqrt(1 - zeta^2))
  const double zeta = 0.2, mass = 0.5 * 1000.0 * 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
  const double rate = std::sqrt(1e4 / mass);
  const double exact = kSpeed / rate * std::exp(-zeta * std::acos(zeta) / std::sqrt(1.0 - zeta * zeta));
  double overlap = 0.0;
  restitution_of(zeta, 2.5e-6, 1.2e-5, overlap);
  // Looked at every 2e-5 s, a fiftieth of the contact's time: the parabola's top is missed by (pi/100)^2 / 2 at most.
  EXPECT_NEAR(overlap, exact, 1e-3 * exact);
}

TEST(dem, oblique_impact_on_a_floor_has_the_reference_values) {
  // R 1 mm, 2500 kg/m3, k = kt = 1e4, Ct = C, e 0.7, mu 0.3, 1 m/s at 45 degrees: an independent integration gives u' 0.468103,
  // R w' -0.597510 with contact until the gap is zero again.
  DemWorld world{{.sub_step = 2e-7, .force_step = true}};
  world.bodies.position[0] = {};
  const double radius = 1e-3, v = std::sqrt(0.5), log_e = std::log(0.7);
  const std::size_t i = world.add_ball({0, 0, radius + 1e-6}, radius, {v, 0, -v}, 2500.0);
  const double zeta = -log_e / std::sqrt(std::numbers::pi * std::numbers::pi + log_e * log_e);
  world.law.damping = 2.0 * zeta * std::sqrt(world.law.stiffness * world.bodies.mass[i]);
  world.law.friction = 0.3;
  world.step(5e-4);
  EXPECT_NEAR(world.bodies.velocity[i].z, 0.7 * v, 1e-5);
  // Second order in the step of 1/500 of the contact's time.
  EXPECT_NEAR(world.bodies.velocity[i].x, 0.468103, 2e-5);
  EXPECT_NEAR(radius * world.bodies.angular_velocity[i].y, 0.597510, 2e-5);  // forwards: about +y when moving along +x
}

TEST(dem, flight_under_gravity_is_exact) {
  DemWorld world;
  world.host.gravity = {1.0, 2.0, -9.81};
  const std::size_t i = world.add_ball({0, 0, 1}, kRadius, {3, 0, 2});
  for (int k = 0; k < 100; ++k) world.step(1e-3);
  const double t = 0.1;
  EXPECT_NEAR(norm(world.bodies.velocity[i] - (Vec3{3, 0, 2} + t * world.host.gravity)), 0.0, 1e-12);
  EXPECT_NEAR(norm(world.bodies.position[i] - (Vec3{0, 0, 1} + t * Vec3{3, 0, 2} + 0.5 * t * t * world.host.gravity)),
              0.0, 1e-12);
}

TEST(dem, a_sliding_ball_rolls_with_five_sevenths_of_its_speed) {
  DemWorld world;
  world.host.gravity = {0, 0, -9.81};
  world.bodies.position[0] = {};
  world.law.friction = 0.3, world.law.damping = 2.0;
  const std::size_t i = world.add_ball({0, 0, kRadius}, kRadius, {0.5, 0, 0});
  const double m = world.bodies.mass[i];
  world.bodies.position[i].z -= m * 9.81 / world.law.stiffness;  // its overlap at rest
  for (int k = 0; k < 200; ++k) world.step(1e-3);                // it rolls after 2 v / (7 mu g) = 49 ms
  // Angular momentum about the floor is kept, whatever the friction; the spring still swings, damped, by less than this.
  EXPECT_NEAR(world.bodies.velocity[i].x, 5.0 / 7.0 * 0.5, 1e-6);
  EXPECT_NEAR(kRadius * world.bodies.angular_velocity[i].y, 5.0 / 7.0 * 0.5, 1e-6);
}

TEST(dem, a_free_body_with_three_moments_keeps_its_momentum_and_flips_in_time) {
  // I = (1, 2, 3), w = (0.01, 1, 0.01): a flip every 19.5528670987 s (Euler's equations with elliptic functions).
  const auto when_flipped = [](double h) {
    DemWorld world{{.sub_step = h, .force_step = true}};
    PrimitiveData box;
    box.primitive.kind = ShapeKind::box, box.primitive.size = {1, 1, 1};
    const std::size_t i = world.bodies.add(1, Motion::dynamic, {}, 1.0, 1.0, {1, 2, 3}, {});
    world.bodies.shape[i] = world.add_shape(box, 1.0);
    world.bodies.angular_velocity[i] = {0.01, 1.0, 0.01};
    const auto momentum = [&] {
      const Quat q = world.bodies.orientation[i];
      return rotate(q, hadamard(world.bodies.inertia[i], rotate_back(q, world.bodies.angular_velocity[i])));
    };
    const Vec3 before = momentum();
    const double dt = 0.02;
    // The angular velocity about the second axis, in the body, passes through zero midway through each flip.
    double last = 1.0, first_zero = 0.0, second_zero = 0.0;
    for (int k = 1; second_zero == 0.0 && k < 3000; ++k) {
      world.step(dt);
      const double now = rotate_back(world.bodies.orientation[i], world.bodies.angular_velocity[i]).y;
      if (last * now < 0.0) {
        (first_zero == 0.0 ? first_zero : second_zero) = dt * (k - 1 + last / (last - now));
      }
      last = now;
    }
    EXPECT_NEAR(norm(momentum() - before), 0.0, 1e-11);
    return second_zero - first_zero;
  };
  const double exact = 19.5528670987, coarse = when_flipped(0.02) - exact, fine = when_flipped(0.01) - exact;
  EXPECT_LT(std::abs(fine), 4e-3);
  EXPECT_GT(coarse / fine, 3.5);  // of second order or better
}

}  // namespace
}  // namespace scree
