// LoadAccount: what contacts gave to one body, summed over steps.
#pragma once

#include <optional>

#include "contact_study/contact_motion.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// How the body moves at the moment of its contacts, and what its torques are about.
struct BodyMotion {
  Pose pose;       ///< [m]
  Twist velocity;  ///< of the body, mean of the step [m/s], [rad/s], world
  Twist surface;   ///< of its surface against it [m/s], [rad/s], world
  Vec3 reference;  ///< point that torques are about [m]
  Vec3 axis;       ///< unit [1]; zero for none
};

/// Sums of impulses; of an interval, and of the whole run.
struct LoadSum {
  Vec3 impulse;                ///< [N s]
  Vec3 angular_impulse;        ///< about the reference [N m s]
  double axial_impulse = 0.0;  ///< of it, along the axis [N m s]
  double work = 0.0;           ///< given to the body and its surface's drive [J]
  double contacts = 0.0;       ///< loaded contacts, summed over steps [1]
  double steps = 0.0;          ///< [1]
  double time = 0.0;           ///< [s]

  void add(const LoadSum& o);
  void save(StateWriter& out) const;
  void load(const StateReader& in);
};

/// What one contact gives to a body: impulse J and angular impulse L on it at point p.
///
///     angular impulse  (p - reference) x J + L
///     work             J . (v + w x (p - x) + surface) + L . (w + surface's turning)
[[nodiscard]] LoadSum load_of(const BodyMotion& body, const Vec3& point, const WorldImpulse& impulse);

/// What contacts did to a body in a step, as the stepper summed it up; the number of contacts is not in it. `centre`: where
/// the body's centre was in the middle of the step [m].
[[nodiscard]] LoadSum load_of(const BodyMotion& body, const Vec3& centre, const ContactLoad& summed);

}  // namespace scree
