// Kernels of one contact: what D^T does to two body velocities, and what D does
// to one impulse. Inlined into every loop over contacts.
#pragma once

#include "scree/ccp/problem.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree {

/// A world vector in the frame of a contact: normal, tangent 1, tangent 2.
inline Vec3 in_frame(const CcpContact& c, const Vec3& v) { return to_contact(contact_frame(c.normal), v); }

/// A vector of the contact's frame, in the world.
inline Vec3 in_world(const CcpContact& c, const Vec3& g) { return to_world(contact_frame(c.normal), g); }

/// D_i^T w: velocity of b's surface relative to a's at the contact [m/s], in its
/// frame, for the velocities `a` and `b` of its bodies.
inline Vec3 relative_velocity(const CcpContact& c, const Twist& a, const Twist& b) {
  const Vec3 u = (b.linear + cross(b.angular, c.arm_b)) - (a.linear + cross(a.angular, c.arm_a));
  return in_frame(c, u);
}

/// D_i g: adds an impulse `g` of the contact's frame [N s] to b, its opposite to
/// a.
inline void add_impulse(const CcpContact& c, const Vec3& g, Twist& a, Twist& b) {
  const Vec3 p = in_world(c, g);
  a.linear -= p;
  a.angular -= cross(c.arm_a, p);
  b.linear += p;
  b.angular += cross(c.arm_b, p);
}

/// Row block i of a flat array of rows.
inline Vec3 load_block(std::span<const double> rows, std::size_t i) {
  return {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]};
}
inline void store_block(std::span<double> rows, std::size_t i, const Vec3& g) {
  rows[3 * i] = g.x;
  rows[3 * i + 1] = g.y;
  rows[3 * i + 2] = g.z;
}

}  // namespace scree
