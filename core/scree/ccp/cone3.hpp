// The Coulomb cone K = {(n, t) in R x R^2: ||t|| <= mu n} and its projections.
//
// Glossary: g = (n, t1, t2), an impulse in the contact frame; mu >= 0, the
// coefficient of friction; K* = {u: u_n >= mu ||u_t||}, the dual cone, in which
// the contact velocity of the associated problem lies; -K*, the polar cone,
// whose points project to zero.
//
// Both projections are closed forms (Tasora & Anitescu 2011, eq. 35; with two
// weights the same derivation): with T = ||t||, the candidate on the surface has
// n' = (d_n n + d_t mu T) / (d_n + mu^2 d_t) and t' = mu n' t / T.
#pragma once

#include <cmath>

#include "scree/math/vec3.hpp"

namespace scree {

/// The point of K nearest to g. Any finite g; unit of g.
inline Vec3 project_cone3(const Vec3& g, double mu) {
  const double t = std::sqrt(g.y * g.y + g.z * g.z);
  if (g.x >= 0.0 && t <= mu * g.x) return g;
  const double n = (g.x + mu * t) / (1.0 + mu * mu);
  if (n <= 0.0) return {};
  // Not inside and n > 0: t > 0. (Without friction t = 0 <= mu n says nothing of n: hence the first condition.)
  const double scale = mu * n / t;
  return {n, scale * g.y, scale * g.z};
}

/// Constants of the projection in the norm d_n n^2 + d_t ||t||^2.
struct ConeWeights {
  double along = 1.0;   ///< d_n / (d_n + mu^2 d_t) [1]
  double across = 0.0;  ///< d_t mu / (d_n + mu^2 d_t) [1]
};

/// Weights for normal stiffness d_n > 0 and tangential stiffness d_t > 0 (same
/// unit).
inline ConeWeights cone_weights(double d_n, double d_t, double mu) {
  const double sum = d_n + mu * mu * d_t;
  return {d_n / sum, d_t * mu / sum};
}

/// The point of K nearest to g in the norm that `w` was made for.
inline Vec3 project_cone3(const Vec3& g, double mu, const ConeWeights& w) {
  const double t = std::sqrt(g.y * g.y + g.z * g.z);
  if (g.x >= 0.0 && t <= mu * g.x) return g;
  const double n = w.along * g.x + w.across * t;
  if (n <= 0.0) return {};
  const double scale = mu * n / t;
  return {n, scale * g.y, scale * g.z};
}

}  // namespace scree
