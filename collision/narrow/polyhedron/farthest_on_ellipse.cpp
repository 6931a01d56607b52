#include "farthest_on_ellipse.hpp"

#include <algorithm>
#include <cmath>

namespace scree::polyhedron {
namespace {

constexpr int kMostSteps = 100;

/// The root of (a / m)^2 + (b / (m + d))^2 = 1 above `m`, where the left side is no less than one. It falls there and is
/// convex, so that Newton's method never overshoots.
double root_above(double m, double a, double b, double d, double sign) {
  for (int step = 0; step < kMostSteps; ++step) {
    const double p = a / m, q = b / (d + sign * m);
    const double slope = -2.0 * p * p / m - sign * 2.0 * q * q / (d + sign * m);
    const double next = m - (p * p + q * q - 1.0) / slope;
    if (!(next > m)) break;  // converged to rounding
    m = next;
  }
  return m;
}

/// The point of a circle nearest to (cosine, sine), with the signs of x and y.
EllipsePoint point_at(double cosine, double sine, double x, double y) {
  const double length = std::hypot(cosine, sine);
  return {std::copysign(cosine / length, cosine * std::copysign(1.0, x)), std::copysign(sine / length, y)};
}

}  // namespace

FarthestPoints farthest_on_ellipse(double alpha, double beta, double x, double y) {
  const double a = std::abs(x) * alpha, b = std::abs(y) * beta;
  const double d = (alpha - beta) * (alpha + beta);
  FarthestPoints found;
  // The axis of the ellipse across which x is zero has two farthest points alike; on it the sine is known at once.
  const double level = d > 0.0 ? std::min(1.0, b / d) : 0.0;
  const double m = std::max(a, b - d);
  if (m > 0.0) {
    const double root = root_above(m, a, b, d, 1.0);
    found.point[found.count++] = point_at(a / root, b / (d + root), x, y);
  } else {
    found.point[found.count++] = point_at(std::sqrt(1.0 - level * level), level, x, y);
  }
  if (!(std::cbrt(a * a) + std::cbrt(b * b) < std::cbrt(d * d))) return found;
  if (a > 0.0) {
    const double root = root_above(a, a, b, d, -1.0);
    found.point[found.count++] = point_at(-a / root, b / (d - root), x, y);
  } else {
    found.point[found.count++] = point_at(-std::sqrt(1.0 - level * level), level, x, y);
  }
  return found;
}

}  // namespace scree::polyhedron
