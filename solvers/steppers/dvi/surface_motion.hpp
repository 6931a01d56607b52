// What surfaces that move against their bodies, as a conveyor belt does, add to the velocities of a contact.
#pragma once

#include "scree/ccp/twist.hpp"
#include "scree/collision/contact.hpp"

namespace scree::dvi {

/// Velocity of b's surface relative to a's by the motion of the surfaces alone [m/s], in the contact's frame. A belt slides in
/// its own plane and does not push along the normal: that component is zero, whatever the scene says.
inline Vec3 surface_slip(const BodyView& bodies, const Contact& c, const CcpContact& geometry) {
  if (bodies.surface_motion.empty()) return {};
  const Vec3 u = relative_velocity(geometry, surface_motion(bodies, c.a), surface_motion(bodies, c.b));
  return {0.0, u.y, u.z};
}

}  // namespace scree::dvi
