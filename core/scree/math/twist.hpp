// Twist: linear and angular part of a body's motion, or of what changes it.
#pragma once

#include "scree/math/vec3.hpp"

namespace scree {

/// Six contiguous doubles of one body: a velocity, or the impulse and its moment
/// that change it.
struct Twist {
  Vec3 linear;   ///< of the centre of mass [m/s], or impulse [N s], world
  Vec3 angular;  ///< [rad/s], or moment about the centre of mass [N m s], world

  constexpr Twist& operator+=(const Twist& o) {
    linear += o.linear;
    angular += o.angular;
    return *this;
  }
  constexpr bool operator==(const Twist&) const = default;
};

}  // namespace scree
