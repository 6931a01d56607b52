// The points of an ellipse that are farthest from a point of its plane: where something round can touch a round wall from
// inside.
#pragma once

#include <array>
#include <cstddef>

namespace scree::polyhedron {

/// A point (alpha cosine, beta sine) of an ellipse of half axes alpha, beta.
struct EllipsePoint {
  double cosine = 1.0, sine = 0.0;
};

/// The farthest point first; a second one where another stretch of the ellipse too is farther than all about it.
struct FarthestPoints {
  std::array<EllipsePoint, 2> point;
  std::size_t count = 0;
};

/// Where (x + alpha cos t, y + beta sin t) has its greatest distances from the origin, for alpha >= beta >= 0 [m] and the
/// ellipse's middle at (x, y) [m].
///
/// With a = |x| alpha, b = |y| beta and D = alpha^2 - beta^2 such points have cos t = a / m, sin t = b / (m + D), where m is
/// a root of (a / m)^2 + (b / (m + D))^2 = 1: the one above zero, and, inside of the evolute, where
/// a^(2/3) + b^(2/3) < D^(2/3), the one next below it. (For the nearest point: Eberly, "Distance from a point to an ellipse,
/// an ellipsoid, or a hyperellipsoid" (2013), eq. 11.)
[[nodiscard]] FarthestPoints farthest_on_ellipse(double alpha, double beta, double x, double y);

}  // namespace scree::polyhedron
