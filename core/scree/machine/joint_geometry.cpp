#include "scree/machine/joint_geometry.hpp"

#include <cmath>
#include <numbers>

namespace scree {
namespace {

constexpr Vec3 kAxes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Vec3 axis_of(const Pose& frame, int k) { return rotate(frame.orientation, kAxes[k]); }

int component(JointEquation e, JointEquation first) { return static_cast<int>(e) - static_cast<int>(first); }

/// Orientation of B in A, of the half of the sphere with w >= 0.
Quat turn_of(const JointPlacement& at) {
  const Quat q = conjugate(at.a.orientation) * at.b.orientation;
  return q.w < 0.0 ? Quat{-q.w, -q.x, -q.y, -q.z} : q;
}

/// The two axes whose product an equation is: of A, and of B.
struct AxisPair {
  Vec3 of_a, of_b;
};

AxisPair axes_of(JointEquation e, const JointPlacement& at) {
  if (e == JointEquation::cross) return {axis_of(at.a, 0), axis_of(at.b, 1)};
  return {axis_of(at.a, component(e, JointEquation::tilt_x)), axis_of(at.b, 2)};
}

CcpRow shift_row(const JointPlacement& at, const Vec3& e) {
  const Vec3 p = at.b.position;
  return {{-e, -cross(p - at.centre_a, e)}, {e, cross(p - at.centre_b, e)}};
}

CcpRow angular_row(const Vec3& direction) { return {{{}, -direction}, {{}, direction}}; }

bool is_shift(JointEquation e) { return e <= JointEquation::shift_z; }
bool is_turn(JointEquation e) { return e >= JointEquation::turn_x && e <= JointEquation::turn_z; }

}  // namespace

double equation_value(JointEquation e, const JointPlacement& at, double length, double distance) {
  const Vec3 d = at.b.position - at.a.position;
  if (is_shift(e)) return dot(axis_of(at.a, component(e, JointEquation::shift_x)), d);
  if (e == JointEquation::distance) return norm(d) - distance;
  if (is_turn(e)) {
    const Quat q = turn_of(at);
    return 2.0 * length * Vec3{q.x, q.y, q.z}[component(e, JointEquation::turn_x)];
  }
  const AxisPair axes = axes_of(e, at);
  return length * dot(axes.of_a, axes.of_b);
}

CcpRow equation_row(JointEquation e, const JointPlacement& at, double length) {
  if (is_shift(e)) return shift_row(at, axis_of(at.a, component(e, JointEquation::shift_x)));
  if (e == JointEquation::distance) return shift_row(at, normalized(at.b.position - at.a.position));
  if (is_turn(e)) {
    const Quat q = turn_of(at);
    const Vec3 k = kAxes[component(e, JointEquation::turn_x)];
    return angular_row(length * rotate(at.a.orientation, q.w * k + cross({q.x, q.y, q.z}, k)));
  }
  const AxisPair axes = axes_of(e, at);
  return angular_row(length * cross(axes.of_b, axes.of_a));
}

double coordinate_value(const JointType& type, Coordinate c, const JointPlacement& at) {
  if (c == Coordinate::rotation) {
    const Vec3 x = axis_of(at.b, 0);
    return std::atan2(dot(axis_of(at.a, 1), x), dot(axis_of(at.a, 0), x));
  }
  const Vec3 d = at.b.position - at.a.position;
  return type.stretches ? norm(d) : dot(axis_of(at.a, 2), d);
}

CcpRow coordinate_row(const JointType& type, Coordinate c, const JointPlacement& at) {
  if (c == Coordinate::rotation) return angular_row(axis_of(at.a, 2));
  return shift_row(at, type.stretches ? normalized(at.b.position - at.a.position) : axis_of(at.a, 2));
}

double nearest_turn(double angle, double near) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle + kTurn * std::round((near - angle) / kTurn);
}

}  // namespace scree
