// How long a step of an explicit method may be for a spring with a dashpot.
#pragma once

#include <cmath>

namespace scree::granular {

/// Effective mass of a solid sphere for what happens along its surface, over that for what happens along the normal:
/// 1 / (1 + m R^2 / I), the same for two spheres and for one on a wall.
inline constexpr double kTangentMass = 2.0 / 7.0;

/// Part of the longest stable step of one contact that a step may be: a body has several contacts at once, whose stiffness and
/// damping add up.
inline constexpr double kPartOfStable = 0.2;

/// Longest stable step [s] of m x'' + C x' + k x = 0 with velocity Verlet and a predicted velocity v + h a of the step before:
/// (h w / 2)^2 + h d = 1 with w^2 = k / m, d = C / m, where the mode that changes its sign every step begins to grow.
[[nodiscard]] inline double longest_stable_step(double mass, double stiffness, double damping) {
  const double d = damping / mass;
  return 2.0 / (std::sqrt(stiffness / mass + d * d) + d);
}

}  // namespace scree::granular
