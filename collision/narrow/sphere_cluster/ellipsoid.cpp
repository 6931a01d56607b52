// Nearest point of an ellipsoid to a point.
//
// Glossary: e, the half axes; y, the point; x, its nearest point of the surface, x_i = e_i^2 y_i / (t + e_i^2), where t is the
// root of F(t) = sum (e_i y_i / (t + e_i^2))^2 - 1 beyond -min e^2. In units of the least half axis: r = (e / e_min)^2,
// z = y / e_min, s = t / e_min^2.
#include <algorithm>
#include <array>
#include <cmath>

#include "nearest.hpp"

namespace scree::sphere_cluster {
namespace {

/// r, z >= 0 by axis, as above, with r >= 1 and r = 1 for at least one axis.
struct Scaled {
  std::array<double, 3> r, z;
};

struct ValueAndSlope {
  double value, slope;
};

/// F(s) and F'(s). Axes on which the point has no coordinate add nothing.
ValueAndSlope evaluate(const Scaled& q, double s) {
  ValueAndSlope f{-1.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    if (q.z[i] == 0.0) continue;
    const double ratio = std::sqrt(q.r[i]) * q.z[i] / (s + q.r[i]);
    f.value += ratio * ratio;
    f.slope -= 2.0 * ratio * ratio / (s + q.r[i]);
  }
  return f;
}

/// The root of F beyond -1; F falls and is convex there, so that Newton's method from the left never overshoots. Starts
/// where the greatest single term is one. -1 when F has no root: the point lies between the centre and the focal ellipse.
double root(const Scaled& q) {
  double s = -1.0;
  for (std::size_t i = 0; i < 3; ++i) s = std::max(s, std::sqrt(q.r[i]) * q.z[i] - q.r[i]);
  if (s == -1.0 && evaluate(q, s).value <= 0.0) return s;
  for (int k = 0; k < 100; ++k) {
    const ValueAndSlope f = evaluate(q, s);
    const double next = s - f.value / f.slope;
    if (!(next > s)) break;  // converged to rounding
    s = next;
  }
  return s;
}

}  // namespace

Nearest nearest_on_ellipsoid(const Vec3& half, const Vec3& p) {
  const double least = std::min({half.x, half.y, half.z});
  Scaled q{};
  double inside = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    q.r[i] = half[axis] / least * (half[axis] / least);
    q.z[i] = std::abs(p[axis]) / least;
    inside += p[axis] / half[axis] * (p[axis] / half[axis]);
  }
  const double s = root(q);
  // In units of the least half axis; the coordinate that the root leaves open follows from the surface.
  Vec3 x;
  double rest = 1.0;
  int open = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    if (s + q.r[i] == 0.0) {
      open = axis;  // of several equal axes any will do
      continue;
    }
    const double along = q.r[i] * q.z[i] / (s + q.r[i]);
    rest -= along * along / q.r[i];
    x[axis] = std::copysign(along, p[axis]);
  }
  if (open >= 0) x[open] = std::copysign(std::sqrt(std::max(0.0, rest)), p[open]);
  const Vec3 slope{x.x / q.r[0], x.y / q.r[1], x.z / q.r[2]};
  const double distance = norm(p - least * x);
  return {inside < 1.0 ? -distance : distance, normalized(slope)};
}

}  // namespace scree::sphere_cluster
