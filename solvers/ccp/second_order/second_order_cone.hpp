// The second-order cone {s: s_0 >= ||(s_1, s_2)||} and its scaling by Nesterov and Todd (1997), with the formulas of
// Vandenberghe, "The CVXOPT linear and quadratic cone program solvers" (2010), section 4. Fewer dimensions are the same with
// zeros: one is the ray s_0 >= 0.
//
// Glossary: s, a point inside; z, a point of the dual (the same) cone; W, the symmetric scaling with W z = W^-1 s = l;
// x o y = (x.y, x_0 y_1 + y_0 x_1, ...), the Jordan product; e = (1, 0, 0), its unit.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/math/vec3.hpp"

namespace scree::second_order {

/// s_0^2 - ||s_1||^2, without the cancellation of squares.
inline double determinant(const Vec3& s) {
  const double t = std::hypot(s.y, s.z);
  return (s.x - t) * (s.x + t);
}

inline Vec3 jordan_product(const Vec3& a, const Vec3& b) {
  return {dot(a, b), a.x * b.y + b.x * a.y, a.x * b.z + b.x * a.z};
}

/// The x with l o x = d, for l inside the cone.
inline Vec3 jordan_quotient(const Vec3& l, const Vec3& d) {
  const double x = (l.x * d.x - l.y * d.y - l.z * d.z) / determinant(l);
  return {x, (d.y - x * l.y) / l.x, (d.z - x * l.z) / l.x};
}

/// The greatest alpha <= `most` with x + alpha d in the cone, for x inside.
inline double step_to_boundary(const Vec3& x, const Vec3& d, double most) {
  const double a = determinant(d), b = x.x * d.x - x.y * d.y - x.z * d.z, c = determinant(x);
  double alpha = d.x < 0.0 ? std::min(most, -x.x / d.x) : most;
  const double root = b * b - a * c;
  if (root < 0.0) return alpha;
  const double q = -(b + std::copysign(std::sqrt(root), b));
  for (const double candidate : {q / a, c / q}) {
    if (candidate > 0.0) alpha = std::min(alpha, candidate);  // not a number: no
  }
  return alpha;
}

/// W = eta (w w^T-like hyperbolic rotation), det w = 1.
struct Scaling {
  double eta = 1.0;
  Vec3 w{1.0, 0.0, 0.0};

  Scaling() = default;
  /// For s and z inside the cone.
  Scaling(const Vec3& s, const Vec3& z) {
    const double root_s = std::sqrt(determinant(s)), root_z = std::sqrt(determinant(z));
    const Vec3 a = s / root_s, b = z / root_z;
    const double half = std::sqrt(0.5 * (1.0 + dot(a, b)));
    w = Vec3{a.x + b.x, a.y - b.y, a.z - b.z} / (2.0 * half);
    w.x = std::sqrt(1.0 + w.y * w.y + w.z * w.z);
    eta = std::sqrt(root_s / root_z);
  }

  /// The scaling of W s and W^-1 z where this one is W, and s and z are given there. The product of scalings keeps the digits
  /// that the points themselves have lost when they come close to the boundary.
  [[nodiscard]] Scaling followed_by(const Scaling& next) const {
    Scaling out;
    out.w = rotate(w, next.w);
    out.w.x = std::sqrt(1.0 + out.w.y * out.w.y + out.w.z * out.w.z);
    out.eta = eta * next.eta;
    return out;
  }

  /// W x.
  [[nodiscard]] Vec3 times(const Vec3& x) const { return eta * rotate(w, x); }
  /// W^-1 x.
  [[nodiscard]] Vec3 over(const Vec3& x) const { return rotate({w.x, -w.y, -w.z}, x) / eta; }

 private:
  static Vec3 rotate(const Vec3& w, const Vec3& x) {
    const double along = w.y * x.y + w.z * x.z, factor = x.x + along / (1.0 + w.x);
    return {w.x * x.x + along, x.y + factor * w.y, x.z + factor * w.z};
  }
};

}  // namespace scree::second_order
