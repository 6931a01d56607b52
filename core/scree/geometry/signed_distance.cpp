#include "scree/geometry/signed_distance.hpp"

#include <algorithm>
#include <limits>

namespace scree {
namespace {

/// Distance in the plane of radius and height to the segment from (ra, za) to (rb, zb).
double segment_distance(double r, double z, double ra, double za, double rb, double zb) {
  const double dr = rb - ra, dz = zb - za;
  const double t = std::clamp(((r - ra) * dr + (z - za) * dz) / (dr * dr + dz * dz), 0.0, 1.0);
  return std::hypot(r - ra - t * dr, z - za - t * dz);
}

}  // namespace

double box_signed_distance(const Vec3& h, const Vec3& p) {
  const Vec3 q{std::abs(p.x) - h.x, std::abs(p.y) - h.y, std::abs(p.z) - h.z};
  const Vec3 outside{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return norm(outside) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

double cylinder_signed_distance(double radius, double half_length, const Vec3& p) {
  const double across = std::sqrt(p.x * p.x + p.y * p.y) - radius, along = std::abs(p.z) - half_length;
  const double a = std::max(across, 0.0), b = std::max(along, 0.0);
  return std::sqrt(a * a + b * b) + std::min(0.0, std::max(across, along));
}

double capsule_signed_distance(double radius, double half_length, const Vec3& p) {
  return norm(p - Vec3{0, 0, std::clamp(p.z, -half_length, half_length)}) - radius;
}

double cone_signed_distance(double radius, double half_height, const Vec3& p) {
  const double r = std::hypot(p.x, p.y);
  const double distance = std::min(segment_distance(r, p.z, 0.0, -half_height, radius, -half_height),
                                   segment_distance(r, p.z, radius, -half_height, 0.0, half_height));
  const bool inside = p.z > -half_height && r * 2.0 * half_height < radius * (half_height - p.z);
  return inside ? -distance : distance;
}

double hull_signed_distance(const ConvexHull& hull, const Vec3& p) {
  double deepest = -std::numeric_limits<double>::infinity();
  const Face* nearest = nullptr;
  for (const Face& face : hull.faces) {
    if (const double height = dot(face.normal, p) - face.offset; height > deepest) {
      deepest = height;
      nearest = &face;
    }
  }
  if (deepest <= 0.0) return deepest;
  // Outside, the nearest plane holds the closest point when the foot of the perpendicular lies on the hull.
  const Vec3 foot = p - deepest * nearest->normal;
  const bool on_hull =
      std::ranges::all_of(hull.faces, [&](const Face& f) { return &f == nearest || dot(f.normal, foot) <= f.offset; });
  if (on_hull) return deepest;
  double squared = std::numeric_limits<double>::infinity();
  for (const Triangle& t : hull.triangles) {
    const TrianglePoint q = closest_on_triangle(p, hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]);
    squared = std::min(squared, squared_norm(p - q.point));
  }
  return std::sqrt(squared);
}

TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, 0};
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + d1 / (d1 - d3) * ab, 3};
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + d2 / (d2 - d6) * ac, 5};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 4};
  const double total = va + vb + vc;
  return {a + vb / total * ab + vc / total * ac, 6};
}

}  // namespace scree
