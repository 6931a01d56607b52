// Compliant contacts of dvi: a spring and a damper, integrated implicitly.
#include "dvi_world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace scree::test {
namespace {

constexpr double kG = 9.81;
constexpr double kRadius = 0.05;
constexpr double kStiffness = 2e4;  // [N/m]

double sphere_mass() { return 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius * 1000.0; }
double damping_of(double ratio) { return 2.0 * ratio * std::sqrt(kStiffness * sphere_mass()); }

/// Gap and its rate of a sphere that is let go where it touches the floor.
struct Compression {
  double gap = 0.0;   ///< [m]
  double rate = 0.0;  ///< [m/s]
};

Compression let_go(double damping, double h, double end, double rolling_friction = 0.0) {
  World w;
  w.host.material(
      {.friction = 0.3, .rolling_friction = rolling_friction, .compliance = 1.0 / kStiffness, .damping = damping});
  const std::size_t i = w.add_sphere({0, 0, kRadius}, kRadius);
  w.run(static_cast<int>(std::lround(end / h)), h);
  return {w.bodies.position[i].z - kRadius, w.bodies.velocity[i].z};
}

// m x'' = -m g - k x - d x' from rest at x = 0, underdamped.
Compression exact(double ratio, double t) {
  const double w0 = std::sqrt(kStiffness / sphere_mass()), wd = w0 * std::sqrt(1 - ratio * ratio);
  const double rest = -kG / (w0 * w0), fade = std::exp(-ratio * w0 * t);
  const double gap = rest - rest * fade * (std::cos(wd * t) + ratio * w0 / wd * std::sin(wd * t));
  return {gap, rest * fade * w0 * w0 / wd * std::sin(wd * t)};
}

// With E = 1 / (h (h k + d)) and b = k gap / (h k + d) the impulse is -h (k x1 + d v1): the implicit Euler step.
TEST(dvi_compliance, step_is_implicit_euler_of_spring_and_damper) {
  const double h = 1e-3, m = sphere_mass(), d = damping_of(0.2);
  World w;
  w.host.material({.compliance = 1.0 / kStiffness, .damping = d});
  const std::size_t i = w.add_sphere({0, 0, kRadius}, kRadius);
  double x = 0.0, v = 0.0;
  for (int k = 0; k < 100; ++k) {
    w.step(h);
    v = (v - h * kG - h / m * kStiffness * x) / (1.0 + h / m * (h * kStiffness + d));
    x += h * v;
    // The solver's tolerance, 1e-13 m/s, over 100 steps.
    ASSERT_NEAR(w.bodies.velocity[i].z, v, 1e-11) << k;
    ASSERT_NEAR(w.dvi.contacts().impulse[0].x, -h * (kStiffness * x + d * v), 1e-11) << k;
    ASSERT_NEAR(w.bodies.position[i].z - kRadius, x, 1e-12) << k;
  }
}

// The damped oscillation is met with an error of first order in h, for contacts that resist rolling too.
TEST(dvi_compliance, oscillation_decays_as_the_damped_spring_does) {
  for (const double rolling_friction : {0.0, 1e-3}) {
    for (const double ratio : {0.1, 0.5}) {
      const double period = 2 * std::numbers::pi * std::sqrt(sphere_mass() / kStiffness), end = 0.9 * period;
      const Compression truth = exact(ratio, end);
      std::array<double, 3> error{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double h = end / (100.0 * std::pow(2.0, static_cast<double>(k)));
        error[k] = std::abs(let_go(damping_of(ratio), h, end, rolling_friction).gap - truth.gap);
      }
      const double rest = kG * sphere_mass() / kStiffness;
      EXPECT_LT(error[0], 0.1 * rest);
      // Halved with the step; the next order shows by a tenth.
      EXPECT_NEAR(error[0] / error[1], 2.0, 0.2) << ratio;
      EXPECT_NEAR(error[1] / error[2], 2.0, 0.1) << ratio;
    }
  }
}

TEST(dvi_compliance, column_at_rest_is_compressed_by_the_weight_above_each_contact) {
  World w;
  w.host.material({.compliance = 1.0 / kStiffness, .damping = damping_of(0.7)});
  for (int k = 0; k < 3; ++k) w.add_sphere({0, 0, kRadius * (2 * k + 1)}, kRadius);
  w.run(1500, 1e-3);
  const ContactView view = w.dvi.contacts();
  ASSERT_EQ(view.size(), 3u);
  for (const Contact& c : view.contact) {
    const double weight = static_cast<double>(4 - c.b) * sphere_mass() * kG;
    // 1.5 s are more than 20 of the slowest mode's decay times.
    EXPECT_NEAR(c.gap, -weight / kStiffness, 1e-8 * weight / kStiffness);
  }
}

// No damping, no loss but that of the implicit step: the rebound falls short by a part of first order in h.
TEST(dvi_compliance, undamped_impact_gives_its_speed_back_as_the_step_shrinks) {
  const double v = 0.5;
  std::array<double, 2> lost{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double h = k == 0 ? 1e-4 : 0.5e-4;
    World w;
    w.host.gravity = {};
    w.host.material({.compliance = 1.0 / kStiffness});
    const std::size_t i = w.add_sphere({0, 0, kRadius}, kRadius, 1000.0, {0, 0, -v});
    while (w.time < 0.03) w.step(h);
    lost[k] = 1.0 - w.bodies.velocity[i].z / v;
  }
  // An implicit Euler step takes w0^2 h / 2 of the amplitude per time; contact lasts pi / w0.
  const double w0 = std::sqrt(kStiffness / sphere_mass());
  EXPECT_NEAR(lost[1], 0.5 * std::numbers::pi * w0 * 0.5e-4, 0.1 * lost[1]);
  EXPECT_NEAR(lost[0] / lost[1], 2.0, 0.2);
}

}  // namespace
}  // namespace scree::test
