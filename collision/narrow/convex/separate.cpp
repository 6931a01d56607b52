#include "separate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "distance.hpp"

namespace scree::convex {
namespace {

/// How far apart b is moved before distances are measured [size of the pair].
constexpr double kClear = 0.05;
constexpr int kMaxClimbs = 60;
/// A climb by less than this is none [size of the pair].
constexpr double kLevel = 1e-10;
/// What an answer may miss [size of the pair].
constexpr double kTrust = 1e-3;
/// An answer that misses no more is exact [size of the pair].
constexpr double kExact = 1e-7;
/// Overlap from which there is more than one way out [size of the pair].
constexpr double kDeep = 0.05;
/// Directions next to each other climb to the same top [1]: a cosine.
constexpr double kNextTo = 0.98;

/// The place of the contact is that of the nearest points, its height that of the supporting planes.
Separation at(const ConvexSolid& a, const ConvexSolid& b, const Vec3& n, const Vec3& on_a, const Vec3& on_b) {
  Separation s{n, separation(a, b, n), {}, {}};
  const double height_a = dot(n, core_support(a, n)) + a.round;
  const Vec3 middle = 0.5 * (on_a + on_b);
  s.on_a = middle + (height_a - dot(n, middle)) * n;
  s.on_b = s.on_a + s.gap * n;
  return s;
}

/// Axes, diagonals of faces and of space.
const std::array<Vec3, 26>& directions() {
  static const std::array<Vec3, 26> list = [] {
    std::array<Vec3, 26> made;
    std::size_t count = 0;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x != 0 || y != 0 || z != 0) made[count++] = normalized(Vec3{double(x), double(y), double(z)});
        }
      }
    }
    return made;
  }();
  return list;
}

/// Normals of the faces of a hull or triangle, in the pair's frame.
void add_face_normals(const ConvexSolid& solid, double sign, std::vector<Vec3>& out) {
  if (solid.kind != ShapeKind::convex_hull) return;
  const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 n = normalized(cross(q - p, r - p));
    if (squared_norm(n) > 0.0) out.push_back(sign * rotate(solid.pose.orientation, n));
  };
  const auto& v = solid.vertices;
  if (solid.loops == nullptr) {
    add(v[0], v[1], v[2]);
    add(v[0], v[2], v[1]);
    return;
  }
  for (const auto& loop : *solid.loops) {
    if (loop.size() > 2) add(v[loop[0]], v[loop[1]], v[loop[2]]);
  }
}

/// Normals around the mantle of a cone.
void add_mantle_normals(const ConvexSolid& cone, double sign, std::vector<Vec3>& out) {
  constexpr int kCount = 16;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount;
    const Vec3 n{2.0 * cone.size.y * std::cos(angle), 2.0 * cone.size.y * std::sin(angle), cone.size.x};
    out.push_back(sign * rotate(cone.pose.orientation, normalized(n)));
  }
}

/// Directions that are likely to be near the best: between the origins, of the axes, of faces.
void add_likely(const ConvexSolid& a, const ConvexSolid& b, std::vector<Vec3>& out) {
  out.clear();
  const Vec3 way = normalized(b.pose.position - a.pose.position);
  if (squared_norm(way) > 0.0) out.push_back(way);
  const Quat between = normalized(Quat{0.9, 0.3, 0.2, 0.4});
  for (const ConvexSolid* solid : {&a, &b}) {
    for (const Vec3& d : directions()) out.push_back(rotate(solid->pose.orientation, d));
    if (solid->kind == ShapeKind::box || solid->kind == ShapeKind::convex_hull) continue;
    for (const Vec3& d : directions()) out.push_back(rotate(solid->pose.orientation, rotate(between, d)));
    if (solid->kind == ShapeKind::cone) add_mantle_normals(*solid, solid == &a ? 1.0 : -1.0, out);
  }
  add_face_normals(a, 1.0, out);
  add_face_normals(b, -1.0, out);
}

/// Directions of the edges of a box or hull, in the pair's frame.
void add_edges(const ConvexSolid& solid, std::vector<Vec3>& out) {
  const auto add = [&](const Vec3& edge) { out.push_back(rotate(solid.pose.orientation, edge)); };
  if (solid.kind == ShapeKind::box) {
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) add(axis);
  }
  if (solid.kind != ShapeKind::convex_hull || solid.loops == nullptr) return;
  for (const auto& loop : *solid.loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t from = loop[k], to = loop[(k + 1) % loop.size()];
      if (from < to) add(normalized(solid.vertices[to] - solid.vertices[from]));
    }
  }
}

/// Across each edge of one and each of the other: with the normals of faces, all there is for two polyhedra.
void add_across_edges(const ConvexSolid& a, const ConvexSolid& b, std::vector<Vec3>& out) {
  std::vector<Vec3> of_a, of_b;
  add_edges(a, of_a);
  add_edges(b, of_b);
  for (const Vec3& u : of_a) {
    for (const Vec3& v : of_b) {
      const Vec3 n = normalized(cross(u, v));
      if (!(squared_norm(n) > 0.5)) continue;
      out.push_back(n);
      out.push_back(-n);
    }
  }
}

/// Whether a point is one of a solid, to what an answer may miss.
bool is_on(const ConvexSolid& solid, const Vec3& point) {
  ConvexSolid dot_solid;
  dot_solid.pose.position = point;
  const Closest way = distance(dot_solid, solid, {});
  return !way.apart || way.distance - solid.round < kTrust;
}

}  // namespace

std::optional<Separation> climb(const ConvexSolid& a, const ConvexSolid& b, const Vec3& start) {
  Vec3 n = start;
  double gap = core_separation(a, b, n);
  const Closest closest = distance(a, b, {});
  if (closest.apart) {
    const double shown = core_separation(a, b, closest.direction);
    // Of two that all but touch, the nearest points say little about the direction.
    if (closest.distance - shown <= kExact) return at(a, b, closest.direction, closest.on_a, closest.on_b);
    if (shown > gap) n = closest.direction;
    gap = std::max(gap, shown);
  }
  for (int step = 0;; ++step) {
    const Vec3 shift = std::max(0.0, kClear - gap) * n;
    const Closest moved = distance(a, b, shift);
    if (!moved.apart || !is_finite(moved.direction)) return std::nullopt;
    const double better = core_separation(a, b, moved.direction);
    const bool level = !(better > gap + kLevel);
    if (!level) {
      n = moved.direction;
      gap = better;
    }
    if (level || step == kMaxClimbs) return at(a, b, n, moved.on_a, moved.on_b - shift);
  }
}

namespace {

/// The best of the climbs from the most promising of the likely directions that are not next to each other.
std::optional<Separation> climb_from_best(const ConvexSolid& a, const ConvexSolid& b, std::span<const Vec3> likely,
                                          std::size_t climbs) {
  std::vector<std::pair<double, Vec3>> ranked;
  for (const Vec3& n : likely) ranked.emplace_back(separation(a, b, n), n);
  std::ranges::stable_sort(ranked, [](const auto& l, const auto& r) { return l.first > r.first; });
  std::vector<Vec3> climbed;
  std::optional<Separation> best;
  for (const auto& start : ranked) {
    const Vec3& n = start.second;
    if (std::ranges::any_of(climbed, [&](const Vec3& other) { return dot(n, other) > kNextTo; })) continue;
    climbed.push_back(n);
    const std::optional<Separation> found = climb(a, b, n);
    if (found && std::isfinite(found->gap) && (!best || found->gap > best->gap)) best = found;
    if (climbed.size() == climbs) break;
  }
  return best;
}

/// True when some likely direction shows less overlap, or, for solids deep in each other, the best of them climb to one
/// that does.
bool is_refuted(const ConvexSolid& a, const ConvexSolid& b, const Separation& found) {
  constexpr std::size_t kClimbs = 6;
  std::vector<Vec3> likely;
  add_likely(a, b, likely);
  const auto is_better = [&](double gap) { return gap > found.gap + kExact; };
  if (std::ranges::any_of(likely, [&](const Vec3& n) { return is_better(separation(a, b, n)); })) return true;
  if (found.gap > -kDeep) return false;
  const auto other = climb_from_best(a, b, likely, kClimbs);
  return other && is_better(other->gap);
}

}  // namespace

std::optional<Separation> checked(const ConvexSolid& a, const ConvexSolid& b, const Answer& answer) {
  const double length = norm(answer.normal);
  if (!std::isfinite(answer.distance) || !std::isfinite(length) || !(length > 0.0)) return std::nullopt;
  Vec3 n = answer.normal / length;
  if (answer.distance < 0.0 && separation(a, b, -n) > separation(a, b, n)) n = -n;
  const double claimed = answer.of_cores ? answer.distance - a.round - b.round : answer.distance;
  const bool has_points = is_finite(answer.on_a) && is_finite(answer.on_b);
  std::optional<Separation> found;
  if (has_points && std::abs(separation(a, b, n) - claimed) <= kExact &&
      (answer.of_cores || (is_on(a, answer.on_a) && is_on(b, answer.on_b)))) {
    found = at(a, b, n, answer.on_a, answer.on_b);
  } else {
    found = climb(a, b, n);
    if (!found || !(std::abs(found->gap - claimed) <= kTrust)) return std::nullopt;
  }
  // Where cores are apart the two bounds settle it; a depth may be that of another way out.
  if (found->gap + a.round + b.round < 0.0 && is_refuted(a, b, *found)) return std::nullopt;
  return found;
}

Separation best_climb(const ConvexSolid& a, const ConvexSolid& b) {
  constexpr std::size_t kClimbs = 24;
  std::vector<Vec3> likely;
  add_likely(a, b, likely);
  add_across_edges(a, b, likely);
  if (const auto best = climb_from_best(a, b, likely, kClimbs)) return *best;
  const Vec3 n = *std::ranges::max_element(likely, {}, [&](const Vec3& d) { return separation(a, b, d); });
  return at(a, b, n, core_support(a, n), core_support(b, -n));
}

}  // namespace scree::convex
