#include "scree/geometry/triangle_crossing.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace scree {
namespace {

Vec3 unit_normal(const TriangleCorners& t) { return normalized(cross(t[1] - t[0], t[2] - t[0])); }

using Distances = std::array<double, 3>;

Distances distances(const TriangleCorners& corners, const Vec3& normal, const Vec3& origin, double tolerance) {
  Distances d{};
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = dot(normal, corners[k] - origin);
    if (std::abs(d[k]) <= tolerance) d[k] = 0.0;
  }
  return d;
}

bool is_cut(const Distances& d) { return *std::ranges::min_element(d) < 0.0 && *std::ranges::max_element(d) > 0.0; }
bool is_in_plane(const Distances& d) { return d == Distances{}; }

/// What lies between two numbers; empty when begin > end.
struct Interval {
  double begin = std::numeric_limits<double>::infinity();
  double end = -std::numeric_limits<double>::infinity();

  void add(double x) {
    begin = std::min(begin, x);
    end = std::max(end, x);
  }
};

/// The part of L, along `line`, in a triangle whose corners are at distances d from the other plane [m].
Interval segment_on_line(const TriangleCorners& corners, const Distances& d, const Vec3& line, const Vec3& origin) {
  Interval segment;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (d[k] == 0.0) segment.add(dot(line, corners[k] - origin));
    if (d[k] * d[next] < 0.0) {
      const Vec3 p = corners[k] + (d[k] / (d[k] - d[next])) * (corners[next] - corners[k]);
      segment.add(dot(line, p - origin));
    }
  }
  return segment;
}

Interval shadow(std::span<const Vec3> points, const Vec3& axis, const Vec3& origin) {
  Interval interval;
  for (const Vec3& p : points) interval.add(dot(axis, p - origin));
  return interval;
}

/// Whether two triangles of one plane have a common area, by the axes across the edges of both.
bool overlap_in_plane(const TriangleCorners& a, const TriangleCorners& b, const Vec3& normal, double tolerance) {
  for (const TriangleCorners* triangle : {&a, &b}) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 axis = normalized(cross(normal, (*triangle)[(k + 1) % 3] - (*triangle)[k]));
      const Interval one = shadow(a, axis, a[0]), other = shadow(b, axis, a[0]);
      if (std::min(one.end, other.end) - std::max(one.begin, other.begin) <= tolerance) return false;
    }
  }
  return true;
}

Vec3 centre_of(const TriangleCorners& t) { return (t[0] + t[1] + t[2]) / 3.0; }

}  // namespace

std::optional<Vec3> crossing_of(const TriangleCorners& a, const TriangleCorners& b, double tolerance) {
  const Vec3 na = unit_normal(a), nb = unit_normal(b);
  if (na == Vec3{} || nb == Vec3{}) return {};
  const Distances db = distances(b, na, a[0], tolerance), da = distances(a, nb, b[0], tolerance);
  if (is_in_plane(db) && is_in_plane(da)) {
    if (dot(na, nb) <= 0.0 || !overlap_in_plane(a, b, na, tolerance)) return {};
    return 0.5 * (centre_of(a) + centre_of(b));
  }
  if (!is_cut(db) || !is_cut(da)) return {};
  const Vec3 line = normalized(cross(na, nb));
  const Interval on_a = segment_on_line(a, da, line, a[0]), on_b = segment_on_line(b, db, line, a[0]);
  const double begin = std::max(on_a.begin, on_b.begin), end = std::min(on_a.end, on_b.end);
  if (end - begin <= tolerance) return {};
  // A point of L: any corner of `a` moved into the plane of `b`, along `a`'s own plane.
  const Vec3 across = normalized(cross(line, na));
  const double slope = dot(across, nb);
  const double height = dot(nb, b[0] - a[0]);
  const Vec3 foot = slope == 0.0 ? a[0] : a[0] + (height / slope) * across;
  return foot + (0.5 * (begin + end) - dot(line, foot - a[0])) * line;
}

bool is_folded(const TriangleCorners& a, const Vec3& third, double tolerance) {
  const Vec3 normal = unit_normal(a);
  if (normal == Vec3{} || std::abs(dot(normal, third - a[0])) > tolerance) return false;
  return dot(cross(normal, a[1] - a[0]), third - a[0]) > tolerance * norm(a[1] - a[0]);
}

std::optional<Vec3> edge_crossing_of(const TriangleCorners& face, const std::array<Vec3, 2>& edge, const Vec3& left,
                                     const Vec3& right, double tolerance) {
  const Vec3 normal = unit_normal(face);
  const auto height = [&](const Vec3& p) { return dot(normal, p - face[0]); };
  if (normal == Vec3{} || std::abs(height(edge[0])) > tolerance || std::abs(height(edge[1])) > tolerance) return {};
  const double one = height(left), other = height(right);
  if (std::abs(one) <= tolerance || std::abs(other) <= tolerance || one * other > 0.0) return {};

  // The part of the edge further than the tolerance inside of all three sides of the face.
  double begin = 0.0, end = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 inward = normalized(cross(normal, face[(k + 1) % 3] - face[k]));
    const double at_begin = dot(inward, edge[0] - face[k]) - tolerance;
    const double at_end = dot(inward, edge[1] - face[k]) - tolerance;
    if (at_begin < 0.0 && at_end < 0.0) return {};
    const double where = at_begin / (at_begin - at_end);
    if (at_begin < 0.0) begin = std::max(begin, where);
    if (at_end < 0.0) end = std::min(end, where);
  }
  const Vec3 along = edge[1] - edge[0];
  if ((end - begin) * norm(along) <= tolerance) return {};
  return edge[0] + (0.5 * (begin + end)) * along;
}

}  // namespace scree
