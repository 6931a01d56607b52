// The judge's residual of one contact.
#pragma once

#include "scree/ccp/cone3.hpp"

namespace scree {

/// Masses s [kg] between which the squares of s u and g have room in a double, whatever u may be.
inline constexpr double kLeastScale = 1e-100, kMostScale = 1e100;

/// Square of || g - P(g - s u) || / s of one contact [m2/s2]; inverse_s = 1/s [1/kg]. The two common cases, a contact that sticks
/// and one that opens, need no root and no division.
inline double squared_natural_map(const Vec3& g, const Vec3& u, double mu, double s, double inverse_s) {
  const Vec3 x = g - s * u;
  const double n = x.x;
  const double tt = x.y * x.y + x.z * x.z;
  const double mu2 = mu * mu;
  if (n >= 0.0 && tt <= mu2 * n * n) return squared_norm(u);                          // x in K: P x = x
  if (n <= 0.0 && mu2 * tt <= n * n) return squared_norm(g) * inverse_s * inverse_s;  // x in -K*: P x = 0
  return squared_norm(g - project_cone3(x, mu)) * inverse_s * inverse_s;
}

/// Square of the residual of one contact [m2/s2] (judge.hpp): impulse `g` [N s], velocity `u` [m/s], 1/s = trace(N_ii) / 3 [1/kg].
/// A cone is the same in every unit: with masses out of the ordinary the map is that of g / s, all in velocities.
inline double squared_contact_residual(const Vec3& g, const Vec3& u, double mu, double s, double inverse_s) {
  if (s > kLeastScale && s < kMostScale) return squared_natural_map(g, u, mu, s, inverse_s);
  return squared_natural_map(inverse_s * g, u, mu, 1.0, 1.0);
}

}  // namespace scree
