#include "conformance/narrow_phase_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "scree/collision/contact.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree::test {
namespace {

using Ranked = std::pair<double, Vec3>;

double local_support(const ReferenceSolid& s, const Vec3& d) {
  const double across = std::hypot(d.x, d.y);
  switch (s.kind) {
    case ShapeKind::sphere:
      return s.size.x * norm(d);
    case ShapeKind::box:
      return s.size.x * std::abs(d.x) + s.size.y * std::abs(d.y) + s.size.z * std::abs(d.z);
    case ShapeKind::cylinder:
      return s.size.x * across + s.size.y * std::abs(d.z);
    case ShapeKind::capsule:
      return s.size.x * norm(d) + s.size.y * std::abs(d.z);
    case ShapeKind::cone:
      return std::max(s.size.y * d.z, s.size.x * across - s.size.y * d.z);
    case ShapeKind::ellipsoid:
      return norm(hadamard(s.size, d));
    case ShapeKind::plane:  // a half space: only straight up is it bounded
      return across < 1e-9 && d.z > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
    case ShapeKind::convex_hull:
    case ShapeKind::triangle_mesh:
    case ShapeKind::sphere_cluster:
      break;
  }
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : s.vertices) farthest = std::max(farthest, dot(v, d));
  return farthest;
}

double support(const ReferenceSolid& s, const Vec3& d) {
  return dot(s.pose.position, d) + local_support(s, rotate_back(s.pose.orientation, d));
}

/// s of a direction of any length, which it scales with: a concave function.
double cone_of(const ReferenceSolid& a, const ReferenceSolid& b, const Vec3& d) {
  return -support(a, d) - support(b, -d);
}

/// Points spread evenly over the unit sphere (Fibonacci's spiral).
std::vector<Vec3> spread(int count) {
  std::vector<Vec3> out;
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
    out.push_back({r * std::cos(golden * i), r * std::sin(golden * i), z});
  }
  return out;
}

/// The maximum of f over [-w, w] for a function without a second one.
template <class Function>
std::pair<double, double> golden_maximum(const Function& f, double w, int steps) {
  const double shrink = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = -w, high = w;
  double x = high - shrink * (high - low), y = low + shrink * (high - low);
  double fx = f(x), fy = f(y);
  for (int i = 0; i < steps; ++i) {
    if (fx > fy) {
      high = y;
      y = x;
      fy = fx;
      x = high - shrink * (high - low);
      fx = f(x);
    } else {
      low = x;
      x = y;
      fx = fy;
      y = low + shrink * (high - low);
      fy = f(y);
    }
  }
  return fx > fy ? std::pair{x, fx} : std::pair{y, fy};
}

/// Climbs within `w` of the unit vector `from`, over the plane that touches the sphere of directions there. On it s, not
/// yet divided by the length, is concave, and s / length too rises to one top where s > 0.
Ranked climb(const ReferenceSolid& a, const ReferenceSolid& b, const Ranked& from, double w, int steps) {
  const ContactFrame frame = contact_frame(from.second);
  const auto direction = [&](double x, double y) { return frame.normal + x * frame.tangent1 + y * frame.tangent2; };
  const auto height = [&](double x, double y) {
    const Vec3 d = direction(x, y);
    return from.first > 0.0 ? cone_of(a, b, d) / norm(d) : cone_of(a, b, d);
  };
  const auto best_y = [&](double x) { return golden_maximum([&](double y) { return height(x, y); }, w, steps); };
  const double x = golden_maximum([&](double at) { return best_y(at).second; }, w, steps).first;
  const Vec3 n = normalized(direction(x, best_y(x).first));
  const Ranked found{cone_of(a, b, n), n};
  return found.first > from.first ? found : from;
}

/// Walks by ever shorter steps in eight directions, for round tops on which climb() makes little way.
Ranked walk(const ReferenceSolid& a, const ReferenceSolid& b, Ranked from) {
  double turn = 0.0;
  for (double step = 0.2; step > 1e-8;) {
    const ContactFrame frame = contact_frame(from.second);
    Ranked best = from;
    for (int k = 0; k < 8; ++k) {
      const double angle = turn + k * std::numbers::pi / 4.0;
      const Vec3 way = std::cos(angle) * frame.tangent1 + std::sin(angle) * frame.tangent2;
      const Vec3 n = normalized(from.second + step * way);
      if (const double s = cone_of(a, b, n); s > best.first) best = {s, n};
    }
    turn += 0.4;
    if (best.first > from.first) {
      from = best;
    } else {
      step *= 0.5;
    }
  }
  return from;
}

void add_placed(const ReferenceSolid& s, const std::vector<Vec3>& own, std::vector<Vec3>& out) {
  for (const Vec3& d : own) {
    out.push_back(rotate(s.pose.orientation, d));
    out.push_back(-out.back());
  }
}

std::vector<Vec3> candidates(const ReferenceSolid& a, const ReferenceSolid& b) {
  static const std::vector<Vec3> sphere = spread(300);
  std::vector<Vec3> list = sphere;
  const Vec3 way = normalized(b.pose.position - a.pose.position);
  if (squared_norm(way) > 0.0) list.push_back(way);
  for (const ReferenceSolid* s : {&a, &b}) {
    add_placed(*s, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, list);
    add_placed(*s, s->normals, list);
  }
  for (const Vec3& one : a.edges) {
    const Vec3 e = rotate(a.pose.orientation, one);
    for (const Vec3& other : b.edges) {
      const Vec3 n = normalized(cross(e, rotate(b.pose.orientation, other)));
      if (squared_norm(n) < 0.5) continue;
      list.push_back(n);
      list.push_back(-n);
    }
  }
  return list;
}

/// Directions around a solid of revolution: of its mantle, on which the support function has a ridge.
void add_ring(ReferenceSolid& s) {
  const bool cone = s.kind == ShapeKind::cone;
  if (!cone && s.kind != ShapeKind::cylinder && s.kind != ShapeKind::capsule) return;
  for (int i = 0; i < 32; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 32;
    const Vec3 flat{std::cos(angle), std::sin(angle), 0.0};
    s.normals.push_back(cone ? normalized(2.0 * s.size.y * flat + Vec3{0, 0, s.size.x}) : flat);
  }
}

/// Edges of a polyhedron; the axis of a capsule is one, swept by a ball.
void add_edges(const PrimitiveData& data, ReferenceSolid& s) {
  if (s.kind == ShapeKind::box) s.edges = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (s.kind == ShapeKind::capsule) s.edges = {{0, 0, 1}};
  for (const Triangle& t : data.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] < t[(k + 1) % 3]) s.edges.push_back(normalized(data.vertices[t[(k + 1) % 3]] - data.vertices[t[k]]));
    }
    const Vec3& p = data.vertices[t[0]];
    s.normals.push_back(normalized(cross(data.vertices[t[1]] - p, data.vertices[t[2]] - p)));
  }
}

}  // namespace

std::vector<ReferenceSolid> reference_solids(const PrimitiveData& data, const Pose& pose) {
  std::vector<ReferenceSolid> solids;
  if (data.primitive.kind == ShapeKind::sphere_cluster) {
    for (const Sphere& sphere : data.spheres) {
      solids.push_back({ShapeKind::sphere, {sphere.radius, 0, 0}, {transform(pose, sphere.centre), {}}, {}, {}, {}});
    }
    return solids;
  }
  solids.push_back({data.primitive.kind, data.primitive.size, pose, data.vertices, {}, {}});
  add_edges(data, solids[0]);
  add_ring(solids[0]);
  return solids;
}

double separation_along(const ReferenceSolid& a, const ReferenceSolid& b, const Vec3& n) { return cone_of(a, b, n); }

ReferenceGap reference_gap(const ReferenceSolid& a, const ReferenceSolid& b) {
  for (const auto& [solid, sign] : {std::pair{&a, 1.0}, {&b, -1.0}}) {
    if (solid->kind != ShapeKind::plane) continue;
    const Vec3 n = sign * rotate(solid->pose.orientation, {0, 0, 1});
    return {cone_of(a, b, n), n};
  }
  std::vector<Ranked> ranked;
  for (const Vec3& n : candidates(a, b)) ranked.emplace_back(cone_of(a, b, n), n);
  std::ranges::sort(ranked, [](const Ranked& l, const Ranked& r) { return l.first > r.first; });
  // The best starts that are not next to each other; where the solids are apart there is one top only.
  const std::size_t most = ranked[0].first > 0.0 ? 1 : 10;
  std::vector<Ranked> starts;
  for (const Ranked& r : ranked) {
    const auto near = [&](const Ranked& s) { return dot(s.second, r.second) > 0.95; };
    if (std::ranges::none_of(starts, near)) starts.push_back(r);
    if (starts.size() == most) break;
  }
  Ranked best = starts[0];
  for (Ranked start : starts) {
    // Apart there is one top, which may be far away; else there are many starts.
    const bool apart = start.first > 0.0;
    for (const double w : {0.3, 0.3, 0.1}) start = climb(a, b, start, w, apart ? 22 : 14);
    start = walk(a, b, start);
    if (start.first > best.first) best = start;
  }
  for (const double w : {0.1, 0.02, 0.004, 0.0005, 0.00005}) best = climb(a, b, best, w, 22);
  return {best.first, best.second};
}

}  // namespace scree::test
