#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "metal_corona.hpp"
#include "scree/config/validate.hpp"
#include "support/fake_electric_field.hpp"
#include "support/fake_scene_services.hpp"
#include "support/semi_implicit.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

using test::Flight;
using test::ThreeSteps;

constexpr double kPi = std::numbers::pi;

/// A metal grain (r 1.5 mm, 8400 kg/m3, 0.2 nC) that leaves the roll of the published separator at 35 degrees with the
/// velocity of its surface at 60 rpm, after 0.25 s under gravity, Stokes' drag and the field's force.
Flight fly(double h) {
  constexpr double kRadius = 1.5e-3;
  constexpr double kViscosity = 1.81e-5;
  const test::SeparatorField separator;
  test::FakeSceneServices services;
  services.add_electric_field("gap", separator);
  services.add_body("roll", {.id = 1, .pose = {}, .shape = "roll"});
  MetalCorona field{options_from_text("electric_field = 'gap'\ngrounded = ['roll']", MetalCorona::parameters())};
  field.setup(services);

  const double distance = 0.16 + kRadius + 1e-4;
  const double angle = 35.0 * kPi / 180.0;
  const double speed = 2.0 * kPi * distance;  // 60 rpm
  Flight flight{distance * Vec3{std::cos(angle), std::sin(angle), 0.0},
                speed * Vec3{std::sin(angle), -std::cos(angle), 0.0}};
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(2, flight.position, kRadius, 8400.0, flight.velocity);
  services.attributes().column(services.attributes().id("charge_induced"))[0] = 2e-10;
  services.attributes().column(services.attributes().id("metal_fraction"))[0] = 1.0;

  const long steps = std::lround(0.25 / h);
  for (long k = 0; k < steps; ++k) {
    test::advance_flight(flight, h, [&](const Flight& at) {
      bodies.position[0] = at.position;
      field.add_forces(bodies.view(), at.time, bodies.wrenches());
      const Vec3 drag = -6.0 * kPi * kViscosity * kRadius * at.velocity;
      return Vec3{0.0, -9.81, 0.0} + (bodies.force[0] + drag) / bodies.mass[0];
    });
  }
  return flight;
}

// The end state was computed independently, by a Runge-Kutta method of high order.
TEST(metal_corona, charged_flight_converges_to_the_exact_trajectory_at_first_order) {
  constexpr double kX = 0.284714467;
  constexpr double kY = -0.418933239;
  constexpr double kVx = 0.617594843;
  constexpr double kVy = -3.269630152;
  ThreeSteps x{};
  ThreeSteps y{};
  ThreeSteps vx{};
  ThreeSteps vy{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = test::kThreeSteps[k];
    const Flight end = fly(h);
    x[k] = end.position.x;
    y[k] = end.position.y;
    vx[k] = end.velocity.x;
    vy[k] = end.velocity.y;
    RecordProperty("x_error_" + std::to_string(k), std::to_string(x[k] - kX));
    RecordProperty("y_error_" + std::to_string(k), std::to_string(y[k] - kY));
    // Free fall is ahead by g h t / 2 = 1.23 m/s h; the field changes this by less than a tenth.
    EXPECT_NEAR(end.position.y, kY - 9.81 * h * 0.25 / 2.0, 0.15 * h);
    EXPECT_NEAR(end.position.x, kX, 0.15 * h);
  }
  EXPECT_NEAR(test::observed_order(y, kY), 1.0, 0.02);
  EXPECT_NEAR(test::observed_order(x, kX), 1.0, 0.1);
  // Extrapolation leaves errors of third order, below 1e-9 here, and the state is given to nine digits.
  EXPECT_NEAR(test::extrapolated(x), kX, 5e-9);
  EXPECT_NEAR(test::extrapolated(y), kY, 5e-9);
  EXPECT_NEAR(test::extrapolated(vx), kVx, 5e-8);
  EXPECT_NEAR(test::extrapolated(vy), kVy, 5e-8);
}

}  // namespace
}  // namespace scree
