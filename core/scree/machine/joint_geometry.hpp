// Joint geometry: values of a joint's equations and coordinates for given poses, and their Jacobian.
//
// A row takes the velocities of the bodies to the rate of the value (joint_type.hpp). With p the origin of B and x the
// centres of mass, w the angular velocities and e a direction fixed in A:
//
//     d/dt (e . d) = e . (v_b + w_b x (p - x_b)) - e . (v_a + w_a x (p - x_a))
//     d/dt (L s . t) = L (w_b - w_a) . (t x s)          s fixed in A, t in B
//     d/dt (2 q_k) = ((w e + v x e_k)_A) . (w_b - w_a)   q = (w, v)
#pragma once

#include "scree/ccp/problem.hpp"
#include "scree/machine/joint_type.hpp"

namespace scree {

/// The two frames of a joint in the world, and the centres of its bodies.
struct JointPlacement {
  Pose a, b;                ///< frames [m]
  Vec3 centre_a, centre_b;  ///< of mass [m]

  /// For bodies at the given poses; the world is at the identity.
  JointPlacement(const Joint& joint, const Pose& body_a, const Pose& body_b)
      : a{body_a * joint.a.frame}, b{body_b * joint.b.frame}, centre_a{body_a.position}, centre_b{body_b.position} {}
};

/// Value of an equation [m]; `length` is L [m], `distance` that of the joint [m].
[[nodiscard]] double equation_value(JointEquation e, const JointPlacement& at, double length, double distance);
/// Its row [1], [m].
[[nodiscard]] CcpRow equation_row(JointEquation e, const JointPlacement& at, double length);

/// Value of a coordinate: [m], or [rad] in (-pi, pi].
[[nodiscard]] double coordinate_value(const JointType& type, Coordinate c, const JointPlacement& at);
/// Its row: [1] of a translation, [1] times 1/m of a rotation: unscaled.
[[nodiscard]] CcpRow coordinate_row(const JointType& type, Coordinate c, const JointPlacement& at);

/// The angle of all those that differ from `angle` by whole turns that lies nearest to `near` [rad].
[[nodiscard]] double nearest_turn(double angle, double near);

/// Rate of a row for two velocities.
[[nodiscard]] inline double row_rate(const CcpRow& row, const Twist& a, const Twist& b) {
  return dot(row.a.linear, a.linear) + dot(row.a.angular, a.angular) + dot(row.b.linear, b.linear) +
         dot(row.b.angular, b.angular);
}

/// A row times a number.
[[nodiscard]] inline CcpRow scaled(const CcpRow& row, double s) {
  return {{s * row.a.linear, s * row.a.angular}, {s * row.b.linear, s * row.b.angular}};
}

}  // namespace scree
