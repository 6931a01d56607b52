#include "simplex.hpp"

#include <algorithm>
#include <limits>

namespace scree::polyhedron {
namespace {

/// A triangle whose sine is smaller than the root of this is a line.
constexpr double kFlat = 1e-20;

/// Nearest point of part of a simplex, with the weights of its corners.
struct Foot {
  Vec3 v;
  std::array<double, 3> weight{};
};

Foot on_segment(const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  const double length2 = squared_norm(e);
  const double t = -dot(a, e);
  if (!(t > 0.0)) return {a, {1.0, 0.0, 0.0}};
  if (t >= length2) return {b, {0.0, 1.0, 0.0}};
  const double s = t / length2;
  return {a + s * e, {1.0 - s, s, 0.0}};
}

/// The best of the three sides, for triangles without area.
Foot on_sides(const Vec3& a, const Vec3& b, const Vec3& c) {
  Foot best = on_segment(a, b);
  const Foot bc = on_segment(b, c);
  if (squared_norm(bc.v) < squared_norm(best.v)) best = {bc.v, {0.0, bc.weight[0], bc.weight[1]}};
  const Foot ca = on_segment(c, a);
  if (squared_norm(ca.v) < squared_norm(best.v)) best = {ca.v, {ca.weight[1], 0.0, ca.weight[0]}};
  return best;
}

Foot on_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 n = cross(ab, ac);
  const double area2 = squared_norm(n);
  if (!(area2 > kFlat * squared_norm(ab) * squared_norm(ac))) return on_sides(a, b, c);
  const double d1 = -dot(ab, a), d2 = -dot(ac, a);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, {1.0, 0.0, 0.0}};
  const double d3 = -dot(ab, b), d4 = -dot(ac, b);
  if (d3 >= 0.0 && d4 <= d3) return {b, {0.0, 1.0, 0.0}};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {a + t * ab, {1.0 - t, t, 0.0}};
  }
  const double d5 = -dot(ab, c), d6 = -dot(ac, c);
  if (d6 >= 0.0 && d5 <= d6) return {c, {0.0, 0.0, 1.0}};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {a + t * ac, {1.0 - t, 0.0, t}};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {b + t * (c - b), {0.0, 1.0 - t, t}};
  }
  // Along the normal, so that the direction stays good however close the origin is.
  const double scale = 1.0 / (va + vb + vc);
  return {(dot(n, a) / area2) * n, {va * scale, vb * scale, vc * scale}};
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

}  // namespace

Vec3 Simplex::reduce() {
  std::array<std::uint32_t, 3> part{0, 1, 2};
  Foot foot;
  if (count == 1) {
    foot = {corner[0].w, {1.0, 0.0, 0.0}};
  } else if (count == 2) {
    foot = on_segment(corner[0].w, corner[1].w);
  } else if (count == 3) {
    foot = on_triangle(corner[0].w, corner[1].w, corner[2].w);
  } else {
    // The side without the newest corner was the nearest before, and the new corner lies beyond it.
    static constexpr std::array<std::array<std::uint32_t, 4>, 3> kSides{{{0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    double least = std::numeric_limits<double>::infinity();
    for (const auto& side : kSides) {
      const Vec3 &p = corner[side[0]].w, &q = corner[side[1]].w, &r = corner[side[2]].w, &s = corner[side[3]].w;
      const Vec3 n = cross(q - p, r - p);
      // Origin and fourth corner on the same side of this plane; flat tetrahedra have no inside.
      if (dot(n, s - p) * -dot(n, p) > 0.0) continue;
      const Foot there = on_triangle(p, q, r);
      const double d2 = squared_norm(there.v);
      if (d2 >= least) continue;
      least = d2;
      foot = there;
      part = {side[0], side[1], side[2]};
    }
    if (least == std::numeric_limits<double>::infinity()) {
      const Vec3 &p = corner[0].w, &q = corner[1].w, &r = corner[2].w, &s = corner[3].w;
      const double total = dot(q - p, cross(r - p, s - p));
      weight = {volume(q, r, s) / total, -volume(p, r, s) / total, volume(p, q, s) / total, -volume(p, q, r) / total};
      return {};
    }
  }
  std::array<SimplexCorner, 3> kept;
  std::uint32_t kept_count = 0;
  for (std::size_t k = 0; k < std::min(count, 3u); ++k) {
    if (foot.weight[k] == 0.0) continue;
    weight[kept_count] = foot.weight[k];
    kept[kept_count++] = corner[part[k]];
  }
  for (std::uint32_t k = 0; k < kept_count; ++k) corner[k] = kept[k];
  count = kept_count;
  return foot.v;
}

}  // namespace scree::polyhedron
