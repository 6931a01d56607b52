// Rotation of a body over one step: the exponential map, and the gyroscopic
// torque of a free body.
//
// Glossary: R, body to world; W, angular velocity in the body frame; I, the
// principal moments; h, the step.
//
// The gyroscopic change of W is the implicit midpoint rule for Euler's equation,
//     I (W1 - W0) = h (I Wm) x Wm,   Wm = (W0 + W1) / 2,
// which keeps the energy and |I W| exactly. Turning R by the Cayley map of h Wm
// keeps the angular momentum R I W in the world exactly as well (Simo & Wong
// 1991, "Unconditionally stable algorithms for rigid body dynamics").
#pragma once

#include "scree/math/quat.hpp"

namespace scree::dvi {

/// q turned by the rotation vector `angle` [rad], world, and brought back to
/// unit length.
[[nodiscard]] inline Quat turned(const Quat& q, const Vec3& angle) {
  return normalized(from_rotation_vector(angle) * q);
}

/// Change of the angular velocity [rad/s], body frame, by the gyroscopic torque
/// over `h` [s]. `inertia` [kg m2] principal moments, `w` [rad/s] body frame.
[[nodiscard]] Vec3 gyroscopic_change(const Vec3& inertia, const Vec3& w, double h);

/// The rotation vector whose rotation is the Cayley map of `angle` [rad].
[[nodiscard]] Vec3 cayley_angle(const Vec3& angle);

}  // namespace scree::dvi
