#include "segments.hpp"

#include <algorithm>
#include <cmath>

namespace scree::polyhedron {
namespace {

/// Squared sine below which segments are parallel.
constexpr double kParallel = 1e-16;
/// Nearer than this, in sizes, two segments cross.
constexpr double kCrossing = 1e-9;

double clamped(double t) { return std::clamp(t, 0.0, 1.0); }

/// A unit vector across both directions, or across the first one when they are parallel.
Vec3 across(const Vec3& u, const Vec3& v) {
  const Vec3 n = cross(u, v);
  const double limit = kParallel * squared_norm(u) * squared_norm(v);
  if (squared_norm(n) > limit) return normalized(n);
  const Vec3 along = normalized(u);
  if (along == Vec3{}) return {1, 0, 0};
  return normalized(cross(along, std::abs(along.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
}

}  // namespace

std::array<Vec3, 2> nearest_of_segments(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const Vec3 r = p - q;
  const double uu = squared_norm(u), vv = squared_norm(v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  if (!(uu > 0.0)) return {p, vv > 0.0 ? q + clamped(vr / vv) * v : q};
  if (!(vv > 0.0)) return {p + clamped(-ur / uu) * u, q};
  const double determinant = uu * vv - uv * uv;
  double s = 0.0;
  if (determinant > kParallel * uu * vv) {
    s = clamped((uv * vr - ur * vv) / determinant);
  } else {
    const double one = clamped(-ur / uu), other = clamped((uv - ur) / uu);
    s = 0.5 * (one + other);
  }
  const double t = clamped((uv * s + vr) / vv);
  s = clamped((uv * t - ur) / uu);
  return {p + s * u, q + t * v};
}

Meeting meeting_of_segments(const PlacedPair& pair) {
  const Vec3 p = pair.a.corner(0), q = pair.corner_b(0);
  const Vec3 u = pair.a.corner(1) - p, v = pair.corner_b(1) - q;
  const auto [on_a, on_b] = nearest_of_segments(p, u, q, v);
  const Vec3 way = on_b - on_a;
  const double length = norm(way);
  if (length > kCrossing * pair.size) return {way / length, length, on_a, on_b};
  const Vec3 n = across(u, v);
  return {dot(n, pair.centre_b() - pair.centre_a()) < 0.0 ? -n : n, 0.0, on_a, on_b};
}

}  // namespace scree::polyhedron
