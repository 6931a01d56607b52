// Prescribed motions against their functions, over many steps of a stepper that moves kinematic bodies by their velocities.
#include "scree/machine/prescribed/prescribed_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scree/machine/functions/testing_function.hpp"
#include "scree/model/body_store.hpp"

namespace scree {
namespace {

using test::function_of;

constexpr double kPi = std::numbers::pi;

BodyStore one_body(const Pose& pose) {
  BodyStore bodies;
  NewBody body;
  body.motion = Motion::kinematic;
  body.pose = pose;
  bodies.add(body);
  return bodies;
}

/// What a stepper does to kinematic bodies.
void drift(BodyStore& bodies, double h) {
  const BodyState s = bodies.state();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    s.position[i] += h * s.velocity[i];
    s.orientation[i] = normalized(from_rotation_vector(h * s.angular_velocity[i]) * s.orientation[i]);
  }
}

/// The velocities alone, without end_step(), keep the body on its way: no error grows from step to step.
TEST(prescribed_motion, velocities_lead_to_the_exact_pose_after_a_hundred_thousand_steps) {
  const double h = 1e-3, amplitude = 2e-3, f = 50.3;
  const Pose written{{1, 2, 3}, {}};
  const TimeFunction swing = function_of("{type = 'sine', amplitude = '2 mm', frequency = '50.3 Hz'}");
  const TimeFunction tilt = function_of("{type = 'sine', amplitude = 0.1, frequency = '7 Hz'}");
  PrescribedMotions motions{
      {PrescribedMotion{0, written, {{{0, 0, 1}, Way::by(swing), {}}, {{1, 0, 0}, Way::by(tilt), Vec3{1, 2, 3}}}}}};
  BodyStore bodies = one_body(written);
  for (int k = 1; k <= 100000; ++k) {
    motions.begin_step(bodies, k * h, h);
    drift(bodies, h);
    if (k % 9973 != 0 && k != 100000) continue;
    const double t = k * h;
    // Positions near 3: a rounding of 4e-16 in x1 - x0 and one in the sum.
    EXPECT_NEAR(bodies.view().position[0].z, 3 + amplitude * std::sin(2 * kPi * f * t), 1e-14) << t;
    const double angle = 0.1 * std::sin(2 * kPi * 7 * t);
    EXPECT_LT(norm(rotate(bodies.view().orientation[0], {0, 1, 0}) - Vec3{0, std::cos(angle), std::sin(angle)}), 1e-14);
  }
}

TEST(prescribed_motion, end_of_a_step_is_the_function_to_the_bit) {
  const double h = 1e-3;
  const TimeFunction swing = function_of("{type = 'sine', amplitude = 0.7, frequency = '3 Hz'}");
  PrescribedMotions motions{{PrescribedMotion{0, {}, {{{1, 0, 0}, Way::by(swing), {}}}}}};
  BodyStore bodies = one_body({});
  for (int k = 1; k <= 1000; ++k) {
    motions.begin_step(bodies, k * h, h);
    drift(bodies, h);
    motions.end_step(bodies);
    EXPECT_EQ(bodies.view().position[0].x, swing.value(k * h));
  }
}

// x = c + R(w t)(x0 - c): a circle about the axis, whose radius stays, with the velocity w x r of its middle.
TEST(prescribed_motion, turns_about_an_axis_off_the_centre) {
  const double h = 1e-3, speed = 2.0;
  const Vec3 centre{1, 0, 5};
  const Pose written{{1.5, 0, 5}, {}};
  PrescribedMotions motions{
      {PrescribedMotion{0, written, {{{0, 1, 0}, Way::at_speed(function_of("2.0"), h), centre}}}}};
  BodyStore bodies = one_body(written);
  for (int k = 1; k <= 5000; ++k) {
    motions.begin_step(bodies, k * h, h);
    const Vec3 middle = rotate(from_rotation_vector({0, speed * (k - 0.5) * h, 0}), {0.5, 0, 0});
    // The chord of an arc of w h is shorter by (w h)^2 / 24.
    EXPECT_LT(norm(bodies.view().velocity[0] - cross({0, speed, 0}, middle)),
              speed * 0.5 * speed * speed * h * h / 24 * 1.01);
    EXPECT_LT(norm(bodies.view().angular_velocity[0] - Vec3{0, speed, 0}), 1e-11);
    drift(bodies, h);
    const double angle = speed * k * h;
    const Vec3 at = centre + Vec3{0.5 * std::cos(angle), 0, -0.5 * std::sin(angle)};
    EXPECT_LT(norm(bodies.view().position[0] - at), 1e-14);
    motions.end_step(bodies);
  }
}

// Shifts do not move the axes of turns: first the turn, then the shift.
TEST(prescribed_motion, turns_come_before_shifts_and_in_the_order_listed) {
  const TimeFunction quarter{kPi / 2};
  PrescribedMotion motion{0,
                          {{1, 0, 0}, {}},
                          {{{1, 0, 0}, Way::by(TimeFunction{10.0}), {}},
                           {{0, 0, 1}, Way::by(quarter), Vec3{}},
                           {{1, 0, 0}, Way::by(quarter), Vec3{}}}};
  // x -> y by the first turn, y -> z by the second, then 10 along x.
  EXPECT_LT(norm(motion.pose(0.0).position - Vec3{10, 0, 1}), 1e-14);
}

// A speed without a closed integral: its way is the same function of time whatever was asked before, as after a restart.
TEST(prescribed_motion, way_of_a_speed_is_its_integral_and_a_pure_function_of_time) {
  const double h = 1e-2;
  const TimeFunction speed = function_of("{type = 'expression', expression = 'cos(3*t)'}");
  Way way = Way::at_speed(speed, h);
  for (int k = 0; k <= 1000; ++k) {
    // Gauss with five points errs by h^11 a step, roundings add up to 1000 of 1e-18.
    EXPECT_NEAR(way.at(k * h), std::sin(3 * k * h) / 3, 1e-14);
  }
  Way fresh = Way::at_speed(speed, h);
  EXPECT_EQ(fresh.at(1000 * h), way.at(1000 * h));
  EXPECT_EQ(way.at(5 * h), Way::at_speed(speed, h).at(5 * h)) << "back in time";
  EXPECT_NEAR(way.at(0.0123), std::sin(3 * 0.0123) / 3, 1e-15) << "between steps";
}

TEST(prescribed_motion, a_step_that_fails_gives_back_the_velocities) {
  BodyStore bodies = one_body({});
  bodies.state().velocity[0] = {7, 0, 0};
  PrescribedMotions motions{{PrescribedMotion{
      0, {}, {{{1, 0, 0}, Way::by(function_of("{type = 'expression', expression = '1/(t - 2)'}")), {}}}}}};
  EXPECT_THROW(motions.begin_step(bodies, 2.0, 1.0), Error);
  EXPECT_EQ(bodies.view().velocity[0].x, 7.0) << "nothing has changed";
  motions.begin_step(bodies, 3.0, 1.0);
  EXPECT_EQ(bodies.view().velocity[0].x, 1.0);
  motions.undo(bodies);
  EXPECT_EQ(bodies.view().velocity[0].x, 7.0);
}

}  // namespace
}  // namespace scree
