// What a contact did during a step: where its bodies were, what it gave them, how far it slid.
#pragma once

#include <algorithm>
#include <cmath>

#include "scree/collision/contact.hpp"
#include "scree/math/contact_frame.hpp"
#include "scree/model/material.hpp"

namespace scree {

/// The pose of a body at the moment that contacts belong to (ContactView::age): exact for bodies that move evenly.
inline Pose pose_at_contacts(const BodyView& bodies, BodyIndex i, double age) {
  const Pose now{bodies.position[i], bodies.orientation[i]};
  if (age == 0.0 || bodies.motion[i] == Motion::fixed) return now;
  return {now.position - age * bodies.velocity[i],
          normalized(from_rotation_vector(-age * bodies.angular_velocity[i]) * now.orientation)};
}

/// Impulses of contact k on its body b, in the world.
struct WorldImpulse {
  Vec3 linear;   ///< [N s]
  Vec3 angular;  ///< about the contact point [N m s]
};

inline WorldImpulse impulse_on_b(const ContactView& contacts, std::size_t k) {
  const ContactFrame frame = contact_frame(contacts.contact[k].normal);
  return {to_world(frame, contacts.impulse[k]),
          contacts.angular_impulse.empty() ? Vec3{} : to_world(frame, contacts.angular_impulse[k])};
}

/// Mean of the relative velocities at the beginning and the end of the step [m/s], contact frame.
inline Vec3 mean_velocity(const ContactView& contacts, std::size_t k) {
  return 0.5 * (contacts.velocity_before[k] + contacts.velocity_after[k]);
}

/// Length of the two tangential components.
inline double tangential(const Vec3& v) { return std::hypot(v.y, v.z); }

/// The mass that an impact of both bodies acts with: 1 / (1/m_a + 1/m_b) [kg]; zero when neither is moved by forces.
inline double effective_mass(const BodyView& bodies, const Contact& c) {
  const double inverse = inverse_mass(bodies, c.a) + inverse_mass(bodies, c.b);
  return inverse > 0.0 ? 1.0 / inverse : 0.0;
}

/// Kinetic energy that a contact took from its bodies in a step [J]: what the stepper has summed up, rolling resistance
/// included, or - J . (u0 + u1) / 2 without it.
inline double dissipated(const ContactView& contacts, std::size_t k) {
  return contacts.work.empty() ? -dot(contacts.impulse[k], mean_velocity(contacts, k)) : contacts.work[k];
}

/// True when a contact acted in the step: it pushed, or pulled as soft contacts may, which are those whose work is known.
inline bool acts(const ContactView& contacts, std::size_t k) {
  return contacts.impulse[k].x > 0.0 || (!contacts.work.empty() && contacts.impulse[k] != Vec3{});
}

/// The share of Coulomb's limit that the tangential impulse takes, |J_t| / (mu J_n) [1]; 0 without friction or load.
inline double mobilisation(const Vec3& impulse, double friction) {
  const double limit = friction * impulse.x;
  return limit > 0.0 ? tangential(impulse) / limit : 0.0;
}

/// From this share of Coulomb's limit on a contact counts as sliding: solvers come within a percent of the limit.
inline constexpr double kSlidingShare = 0.99;

/// True when a loaded contact slid in the step: it took all of its friction, or has none.
inline bool slides(const Vec3& impulse, double friction) {
  return impulse.x > 0.0 && tangential(impulse) >= kSlidingShare * friction * impulse.x;
}

}  // namespace scree
