// ContactFrame: the axes in which impulses and velocities of a contact are written.
#pragma once

#include <cmath>

#include "scree/math/vec3.hpp"

namespace scree {

/// An orthonormal contact frame: normal, tangent 1, tangent 2, right-handed.
struct ContactFrame {
  Vec3 normal;    ///< [1], world
  Vec3 tangent1;  ///< [1], world
  Vec3 tangent2;  ///< [1], world
};

/// The frame of a normal. A pure function, so that nobody has to store tangents
/// (Duff et al. 2017, branchless basis).
inline ContactFrame contact_frame(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {n, {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// A vector of the contact frame (normal, tangent 1, tangent 2) in the world.
inline Vec3 to_world(const ContactFrame& f, const Vec3& local) {
  return local.x * f.normal + local.y * f.tangent1 + local.z * f.tangent2;
}

/// A world vector in the contact frame.
inline Vec3 to_contact(const ContactFrame& f, const Vec3& v) {
  return {dot(f.normal, v), dot(f.tangent1, v), dot(f.tangent2, v)};
}

}  // namespace scree
