// Grains on a plate that vibrates as prescribed.
#include "dvi_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree::test {
namespace {

constexpr double kG = 9.81;
constexpr double kFrequency = 20.0;  // [Hz]
constexpr double kTurning = 2.0 * std::numbers::pi * kFrequency;
constexpr double kStep = 1e-4;  // [s]

/// A ball on a plate that swings with amplitude x turning^2 = `ratio` x g, let go as the plate passes its middle upwards.
struct Plate {
  explicit Plate(double ratio) : amplitude{ratio * kG / (kTurning * kTurning)} {
    w.bodies.motion[0] = Motion::kinematic;
    ball = w.add_sphere({0, 0, 0.05}, 0.05, 1000.0, {0, 0, amplitude * kTurning});
  }
  [[nodiscard]] double height(double t) const { return amplitude * std::sin(kTurning * t); }
  /// What core does with a prescribed motion: the plate is where its function says at the end of each step.
  void step() {
    const double end = height(w.time + kStep);
    w.bodies.velocity[0].z = (end - w.bodies.position[0].z) / kStep;
    w.step(kStep);
    w.bodies.position[0].z = end;
  }
  /// Of the ball above the plate [m].
  [[nodiscard]] double gap() const { return w.bodies.position[ball].z - 0.05 - w.bodies.position[0].z; }

  World w;
  double amplitude;  // [m]
  std::size_t ball;
};

// The plate pulls down with a w^2 at most: below g the ball is pressed on at all times, with m (g + z'').
TEST(dvi_vibration, ball_stays_on_the_plate_while_its_acceleration_is_below_g) {
  Plate plate{0.95};
  const double m = plate.w.bodies.mass[plate.ball];
  while (plate.w.time < 5.0 / kFrequency) {
    plate.step();
    EXPECT_NEAR(plate.gap(), 0.0, 1e-12);
    if (plate.w.time < 2 * kStep) continue;  // the first step makes up for the step's mean velocity
    const ContactView contacts = plate.w.dvi.contacts();
    ASSERT_EQ(contacts.size(), 1u);
    // z'' as the second difference over a step, (w h)^2 / 12 off; at the step's beginning.
    const double z = plate.height(plate.w.time - kStep);
    EXPECT_NEAR(contacts.impulse[0].x, m * kStep * (kG - kTurning * kTurning * z),
                m * kStep * kG * (kTurning * kTurning * kStep * kStep / 12 + 1e-9));
  }
}

// Above g it leaves where the plate's deceleration is g, sin(w t) = 1 / ratio, and flies freely from there.
TEST(dvi_vibration, ball_leaves_the_plate_where_its_deceleration_passes_g) {
  const double ratio = 2.0;
  Plate plate{ratio};
  const double leaves = std::asin(1.0 / ratio) / kTurning;
  const double z = plate.height(leaves), v = plate.amplitude * kTurning * std::cos(kTurning * leaves);
  double left = 0.0, highest = 0.0;
  while (plate.w.time < 0.5 / kFrequency) {
    plate.step();
    // Speeds part by g ratio w dt^2 / 2: after a step or two the gap is above any rounding.
    if (left == 0.0 && plate.gap() > 1e-12) left = plate.w.time;
    highest = std::max(highest, plate.gap());
    if (plate.w.time < leaves + 2 * kStep) continue;
    const double t = plate.w.time - leaves;
    EXPECT_NEAR(plate.w.bodies.position[plate.ball].z - 0.05, z + v * t - 0.5 * kG * t * t,
                2 * kG * kStep * (t + kStep));
  }
  EXPECT_NEAR(left, leaves, 2 * kStep);
  EXPECT_GT(highest, 0.2 * plate.amplitude);
}

}  // namespace
}  // namespace scree::test
