#include "scree/machine/joint_geometry.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace scree {
namespace {

std::mt19937_64 random_engine{7};

double uniform(double low, double high) { return std::uniform_real_distribution<double>{low, high}(random_engine); }
Vec3 random_vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
Pose random_pose(double turn) { return {random_vector(1.0), from_rotation_vector(random_vector(turn))}; }

/// Bodies somewhere, with frames somewhere on them whose axes differ by up to `turn` [rad] an axis.
struct Pair {
  explicit Pair(double turn) {
    a = random_pose(3.0);
    const Pose frame = random_pose(3.0);
    joint.a = {1, inverse(a) * frame};
    b = random_pose(3.0);
    const Pose other{frame.position + random_vector(0.5),
                     normalized(frame.orientation * from_rotation_vector(random_vector(turn)))};
    joint.b = {2, inverse(b) * other};
  }
  /// Moved by velocities for a time.
  [[nodiscard]] JointPlacement after(const Twist& va, const Twist& vb, double t) const {
    const auto moved = [t](const Pose& p, const Twist& v) {
      return Pose{p.position + t * v.linear, from_rotation_vector(t * v.angular) * p.orientation};
    };
    return {joint, moved(a, va), moved(b, vb)};
  }
  Joint joint;
  Pose a, b;
};

Twist random_twist() { return {random_vector(1.0), random_vector(1.0)}; }

// Law: a row takes velocities to the rate of its equation's value, which central differences give to 1e-9 or so.
TEST(joint_geometry, rows_are_rates_of_the_equations) {
  using enum JointEquation;
  const double t = 1e-6, length = 0.7;
  for (const JointEquation e : {shift_x, shift_y, shift_z, turn_x, turn_y, turn_z, tilt_x, tilt_y, cross, distance}) {
    for (int trial = 0; trial < 50; ++trial) {
      const Pair pair{1.0};
      const Twist va = random_twist(), vb = random_twist();
      const auto value = [&](double at) { return equation_value(e, pair.after(va, vb, at), length, 0.3); };
      const double rate = (value(t) - value(-t)) / (2 * t);
      EXPECT_NEAR(row_rate(equation_row(e, pair.after(va, vb, 0.0), length), va, vb), rate, 1e-8)
          << static_cast<int>(e);
    }
  }
}

// A translation has the rate of its row whatever the frames; a rotation where the axes agree, as its joint makes them.
TEST(joint_geometry, rows_are_rates_of_the_coordinates) {
  const double t = 1e-6;
  for (const char* name : {"prismatic", "cylindrical", "spring_damper"}) {
    const JointType& type = *find_joint_type(name);
    for (int trial = 0; trial < 50; ++trial) {
      const Pair pair{1.0};
      const Twist va = random_twist(), vb = random_twist();
      const auto value = [&](double at) {
        return coordinate_value(type, Coordinate::translation, pair.after(va, vb, at));
      };
      const CcpRow row = coordinate_row(type, Coordinate::translation, pair.after(va, vb, 0.0));
      EXPECT_NEAR(row_rate(row, va, vb), (value(t) - value(-t)) / (2 * t), 1e-8) << name;
    }
  }
  const JointType& hinge = *find_joint_type("revolute");
  for (int trial = 0; trial < 50; ++trial) {
    const Pair pair{0.0};
    const Twist va = random_twist();
    // b turns with a and about the axis they share.
    const Vec3 axis = rotate((pair.a * pair.joint.a.frame).orientation, {0, 0, 1});
    const Twist vb{random_vector(1.0), va.angular + uniform(-1.0, 1.0) * axis};
    const auto value = [&](double at) { return coordinate_value(hinge, Coordinate::rotation, pair.after(va, vb, at)); };
    const CcpRow row = coordinate_row(hinge, Coordinate::rotation, pair.after(va, vb, 0.0));
    EXPECT_NEAR(row_rate(row, va, vb), (value(t) - value(-t)) / (2 * t), 1e-8);
  }
}

// Equations of a joint vanish where its frames agree, and along what the joint leaves free.
TEST(joint_geometry, equations_vanish_along_the_freedom_of_the_joint) {
  for (const JointType& type : joint_types()) {
    Pair pair{0.0};
    const Pose frame = pair.a * pair.joint.a.frame;
    Pose other = frame;
    if (type.turns) other.orientation = frame.orientation * from_rotation_vector({0, 0, 2.5});
    if (type.slides) other.position = transform(frame, {0, 0, 0.4});
    if (type.name == "spherical") other.orientation = random_pose(3.0).orientation;
    if (type.name == "planar") other.position = transform(frame, {0.3, -0.2, 0});
    if (type.name == "universal") {
      other.orientation = frame.orientation * from_rotation_vector({0.4, 0, 0}) * from_rotation_vector({0, 0.7, 0});
    }
    if (type.name == "distance") other.position += Vec3{0.18, 0.24, 0};
    pair.joint.b.frame = inverse(pair.b) * other;
    const JointPlacement at{pair.joint, pair.a, pair.b};
    for (const JointEquation e : type.equations) {
      EXPECT_NEAR(equation_value(e, at, 0.7, 0.3), 0.0, 1e-14) << type.name << " " << static_cast<int>(e);
    }
  }
}

TEST(joint_geometry, turns_are_counted_beyond_half_a_turn) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_NEAR(nearest_turn(-kPi + 0.1, kPi - 0.1), kPi + 0.1, 1e-15);
  EXPECT_NEAR(nearest_turn(0.3, 100 * kPi), 100 * kPi + 0.3, 1e-13);
  EXPECT_NEAR(nearest_turn(0.3, -7 * kPi + 0.5), -6 * kPi + 0.3, 1e-14);
}

}  // namespace
}  // namespace scree
