#include "simplex.hpp"

#include <algorithm>
#include <limits>

namespace scree::polyhedron {
namespace {

/// A triangle whose sine is smaller than the root of this is a line.
constexpr double kFlat = 1e-20;
/// The same of a tetrahedron, as two edges that cross make it from four pairs of their ends.
constexpr double kFlatSolid = 1e-20;

/// Nearest point of part of a simplex, with the weights of its corners.
struct Foot {
  Vec3 v;
  std::array<double, 3> weight{};
};

/// Square to the edge, however close the origin is: two corners may lie far from it on either side.
Foot on_segment(const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  const double length2 = squared_norm(e);
  const double t = -dot(a, e);
  if (!(t > 0.0)) return {a, {1.0, 0.0, 0.0}};
  if (t >= length2) return {b, {0.0, 1.0, 0.0}};
  const double s = t / length2;
  Vec3 v = a + s * e;
  v -= (dot(v, e) / length2) * e;
  return {v, {1.0 - s, s, 0.0}};
}

/// The best of those sides across from a corner that `tries` names.
Foot on_sides(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<bool, 3>& tries) {
  Foot best;
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const Foot& side, const std::array<double, 3>& weight) {
    const double d2 = squared_norm(side.v);
    if (d2 >= least) return;
    least = d2;
    best = {side.v, weight};
  };
  if (tries[2]) {
    const Foot ab = on_segment(a, b);
    take(ab, {ab.weight[0], ab.weight[1], 0.0});
  }
  if (tries[0]) {
    const Foot bc = on_segment(b, c);
    take(bc, {0.0, bc.weight[0], bc.weight[1]});
  }
  if (tries[1]) {
    const Foot ca = on_segment(c, a);
    take(ca, {ca.weight[1], 0.0, ca.weight[0]});
  }
  return best;
}

Foot on_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 n = cross(ab, ac);
  const double area2 = squared_norm(n);
  if (!(area2 > kFlat * squared_norm(ab) * squared_norm(ac))) return on_sides(a, b, c, {true, true, true});
  // Along the normal, so that the direction stays good however close the origin is.
  const Vec3 v = (dot(n, a) / area2) * n;
  const Vec3 to_a = a - v, to_b = b - v, to_c = c - v;
  const double wa = dot(n, cross(to_b, to_c)), wb = dot(n, cross(to_c, to_a)), wc = dot(n, cross(to_a, to_b));
  // The nearest point lies on a side that the origin is beyond.
  if (wa <= 0.0 || wb <= 0.0 || wc <= 0.0) return on_sides(a, b, c, {wa <= 0.0, wb <= 0.0, wc <= 0.0});
  const double scale = 1.0 / (wa + wb + wc);
  return {v, {wa * scale, wb * scale, wc * scale}};
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

}  // namespace

Vec3 Simplex::reduce(bool apart) {
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
      // Origin and fourth corner on the same side of this plane. Flat tetrahedra have no inside, whatever rounding says.
      const double height = dot(n, s - p);
      const bool flat = height * height <= kFlatSolid * squared_norm(n) * squared_norm(s - p);
      if (!apart && !flat && height * -dot(n, p) > 0.0) continue;
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
