// Whether two spheres can meet within a step.
#pragma once

#include "scree/collision/collider_set.hpp"

namespace scree {

/// Of spheres that overlap by more than rounding, the boxes do.
inline constexpr double kTouching = 1.0 - 1e-9;  ///< of the sum of radii [1]

/// True when the bounding spheres come within `reach` [m] of each other.
inline bool spheres_meet(const ColliderMotion& a, const ColliderMotion& b, double reach) {
  const double radii = a.radius + b.radius + reach;
  return squared_norm(b.centre - a.centre) <= radii * radii;
}

/// True when two spheres can meet within the step.
inline bool swept_spheres_meet(const ColliderMotion& a, const ColliderMotion& b, double reach, const ReachRule& rule) {
  const double touching = kTouching * (a.radius + b.radius);
  if (squared_norm(b.centre - a.centre) <= touching * touching) return true;
  // Boxes of spheres are cheaper to compute than to read.
  return spheres_meet(a, b, reach) && overlap(swept_sphere(a, rule), swept_sphere(b, rule));
}

}  // namespace scree
