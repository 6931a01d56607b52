// Kinetic energy of bodies.
#pragma once

#include "scree/model/body.hpp"

namespace scree {

/// Kinetic energy of body i, translation and rotation [J]; zero for one that forces do not move.
inline double kinetic_energy(const BodyView& bodies, BodyIndex i) {
  if (bodies.motion[i] != Motion::dynamic) return 0.0;
  const Vec3 spin = rotate_back(bodies.orientation[i], bodies.angular_velocity[i]);
  return 0.5 * (bodies.mass[i] * squared_norm(bodies.velocity[i]) + dot(spin, hadamard(bodies.inertia[i], spin)));
}

}  // namespace scree
