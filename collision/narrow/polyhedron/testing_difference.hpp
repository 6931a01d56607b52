// The distance and depth of two convex solids from the hull of all differences of their corners: an independent and slow way.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "scree/geometry/convex_hull.hpp"
#include "support/random_numbers.hpp"

namespace scree::test {

/// Distance of the origin from a triangle: foot on the plane when it lies inside by areas, else the nearest of three segments.
inline double origin_to_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = normalized(cross(b - a, c - a));
  const Vec3 foot = dot(n, a) * n;
  const auto inside = [&](const Vec3& from, const Vec3& to) { return dot(cross(to - from, foot - from), n) >= 0.0; };
  if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(dot(n, a));
  const auto segment = [](const Vec3& from, const Vec3& to) {
    const double t = std::clamp(-dot(from, to - from) / squared_norm(to - from), 0.0, 1.0);
    return norm(from + t * (to - from));
  };
  return std::min({segment(a, b), segment(b, c), segment(c, a)});
}

/// Gap of two convex solids given by their corners in one frame [m]: the distance, or the depth as a negative number.
inline double reference_gap(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> differences;
  for (const Vec3& q : b) {
    for (const Vec3& p : a) differences.push_back(q - p);
  }
  const ConvexHull hull = convex_hull(differences);
  double least = std::numeric_limits<double>::infinity();
  for (const Face& face : hull.faces) least = std::min(least, face.offset);
  if (least >= 0.0) return -least;
  least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : hull.triangles) {
    least = std::min(least, origin_to_triangle(hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]));
  }
  return least;
}

/// How far two solids are apart along n [m], from all corners.
inline double separation_along(const Vec3& n, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = -std::numeric_limits<double>::infinity(), least = -most;
  for (const Vec3& p : a) most = std::max(most, dot(n, p));
  for (const Vec3& q : b) least = std::min(least, dot(n, q));
  return least - most;
}

}  // namespace scree::test
