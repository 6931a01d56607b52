#include "mesh_tree.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace scree::sphere_cluster {
namespace {

constexpr std::uint32_t kLeafSize = 4;
/// Points nearer than this, in radii, are one contact; squared distances that
/// differ by less than its square are a tie. Far above rounding, far below what a
/// contact notices.
constexpr double kSamePoint = 2e-6;
constexpr double kTie = 1e-12;

double squared_distance(const Aabb& box, const Vec3& p) {
  const Vec3 inside{std::clamp(p.x, box.lower.x, box.upper.x), std::clamp(p.y, box.lower.y, box.upper.y),
                    std::clamp(p.z, box.lower.z, box.upper.z)};
  return squared_norm(p - inside);
}

/// Corners of the edge or vertex that a part names, as positions 0..2; equal for a vertex.
std::array<int, 2> corners_of(TrianglePart part) {
  switch (part) {
    case TrianglePart::edge_ab:
      return {0, 1};
    case TrianglePart::edge_bc:
      return {1, 2};
    case TrianglePart::edge_ca:
      return {2, 0};
    case TrianglePart::vertex_b:
      return {1, 1};
    case TrianglePart::vertex_c:
      return {2, 2};
    case TrianglePart::vertex_a:
    case TrianglePart::face:
      break;
  }
  return {0, 0};
}

/// Angle between two edges that leave a vertex [rad].
double angle(const Vec3& u, const Vec3& v) { return std::atan2(norm(cross(u, v)), dot(u, v)); }

/// True when p lies to the left of the way from u to v, seen from above. Of two triangles that share an edge each is asked the
/// other way round, and gets the opposite answer: what lies on the edge counts as lying a little further along x, and still
/// less along y.
bool passes_left(const Vec3& u, const Vec3& v, const Vec3& p) {
  const bool turned = u.x != v.x ? u.x > v.x : u.y > v.y;
  const Vec3 &from = turned ? v : u, &to = turned ? u : v;
  const double side = (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  // The derivative along x, and where that vanishes along y.
  const bool left = side != 0.0 ? side > 0.0 : (to.y != from.y ? to.y < from.y : to.x > from.x);
  return left != turned;
}

}  // namespace

MeshTree::MeshTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  weld(vertices, triangles);
  find_closed();
  find_bounded();
  if (!entries_.empty()) build(0, static_cast<std::uint32_t>(entries_.size()));
}

void MeshTree::weld(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  // The first vertex of each place stands for all of them.
  std::vector<std::uint32_t> used;
  for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
  const auto place = [&](std::uint32_t i) { return std::tuple{vertices[i].x, vertices[i].y, vertices[i].z}; };
  std::sort(used.begin(), used.end(),
            [&](std::uint32_t l, std::uint32_t r) { return place(l) != place(r) ? place(l) < place(r) : l < r; });
  const auto representative = [&](std::uint32_t i) {
    const auto at = std::lower_bound(used.begin(), used.end(), i,
                                     [&](std::uint32_t l, std::uint32_t r) { return place(l) < place(r); });
    return *at;
  };
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto& [i, j, l] = triangles[k];
    const Vec3 area = cross(vertices[j] - vertices[i], vertices[l] - vertices[i]);
    if (!(norm(area) > 0.0)) continue;
    entries_.push_back({vertices[i],
                        vertices[j],
                        vertices[l],
                        normalized(area),
                        {representative(i), representative(j), representative(l)},
                        static_cast<std::uint32_t>(k)});
  }
}

void MeshTree::find_closed() {
  // Every directed edge must occur once, and so must its opposite.
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const Entry& e : entries_) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({e.corner[k], e.corner[(k + 1) % 3]});
  }
  std::sort(edges.begin(), edges.end());
  closed_ = !edges.empty() && std::adjacent_find(edges.begin(), edges.end()) == edges.end() &&
            std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
              return std::binary_search(edges.begin(), edges.end(), std::array{e[1], e[0]});
            });
}

void MeshTree::find_bounded() {
  // Six times the volume, from tetrahedra with a corner in common.
  double volume = 0.0;
  for (const Entry& e : entries_) {
    const Vec3& apex = entries_[0].a;
    volume += dot(e.a - apex, cross(e.b - apex, e.c - apex));
  }
  bounded_ = closed_ && volume > 0.0;
}

void MeshTree::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t at = nodes_.size();
  Aabb box = Aabb::empty();
  Aabb centres = Aabb::empty();
  for (std::uint32_t i = first; i < last; ++i) {
    const Entry& e = entries_[i];
    box = merged(merged(merged(box, e.a), e.b), e.c);
    centres = merged(centres, e.a + e.b + e.c);
  }
  nodes_.push_back({box, 0, first, last - first});
  if (last - first > kLeafSize) {
    nodes_[at].count = 0;
    const Vec3 extent = centres.upper - centres.lower;
    const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
    const std::uint32_t middle = first + (last - first) / 2;
    const auto begin = entries_.begin();
    std::nth_element(begin + first, begin + middle, begin + last, [axis](const Entry& l, const Entry& r) {
      const double cl = l.a[axis] + l.b[axis] + l.c[axis];
      const double cr = r.a[axis] + r.b[axis] + r.c[axis];
      return cl != cr ? cl < cr : l.triangle < r.triangle;
    });
    build(first, middle);
    build(middle, last);
  }
  nodes_[at].skip = static_cast<std::uint32_t>(nodes_.size());
}

void MeshTree::collect(const Vec3& p, double radius, std::vector<MeshHit>& hits) const {
  hits.clear();
  const double limit = radius * radius;
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    if (squared_distance(node.box, p) > limit) {
      n = node.skip;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Entry& e = entries_[i];
      const double height = dot(e.normal, p - e.a);
      if (height * height > limit) continue;
      const OnTriangle on = nearest_on_triangle(e.a, e.b, e.c, p);
      const double distance2 = squared_norm(p - on.point);
      if (distance2 <= limit) hits.push_back({on.point, distance2, i, on.part});
    }
    ++n;
  }
}

/// True when a line upwards from p leaves the mesh once more than it enters. Wrong at worst where it grazes a triangle that stands
/// upright but for rounding.
bool MeshTree::encloses(const Vec3& p) const {
  bool inside = false;
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const Aabb& box = node.box;
    if (!(box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && p.z <= box.upper.z)) {
      n = node.skip;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Entry& e = entries_[i];
      const bool ab = passes_left(e.a, e.b, p), bc = passes_left(e.b, e.c, p), ca = passes_left(e.c, e.a, p);
      if (ab != bc || bc != ca) continue;
      const double height = dot(e.normal, p - e.a);
      if (e.normal.z > 0.0 ? height < 0.0 : height > 0.0) inside = !inside;
    }
    ++n;
  }
  return inside;
}

bool MeshTree::shares_feature(const MeshHit& hit, const MeshHit& other) const {
  const auto& mine = entries_[hit.entry].corner;
  const auto& theirs = entries_[other.entry].corner;
  for (const int k : corners_of(hit.part)) {
    if (std::find(theirs.begin(), theirs.end(), mine[static_cast<std::size_t>(k)]) == theirs.end()) return false;
  }
  return true;
}

bool MeshTree::is_local_minimum(const MeshHit& hit, std::span<const MeshHit> hits) const {
  if (hit.part == TrianglePart::face) return true;
  // A neighbour that holds this point, but has a nearer one, leads downhill.
  return std::none_of(hits.begin(), hits.end(), [&](const MeshHit& other) {
    return other.distance2 < hit.distance2 * (1.0 - kTie) && shares_feature(hit, other);
  });
}

Vec3 MeshTree::outward(const MeshHit& nearest, std::span<const MeshHit> hits) const {
  if (nearest.part == TrianglePart::face) return entries_[nearest.entry].normal;
  // Angle-weighted normal of the triangles about the point: its side is the sign
  // of the distance (Baerentzen and Aanaes 2005).
  const bool vertex = corners_of(nearest.part)[0] == corners_of(nearest.part)[1];
  Vec3 sum;
  for (const MeshHit& hit : hits) {
    if (!shares_feature(nearest, hit)) continue;
    const Entry& e = entries_[hit.entry];
    double weight = 1.0;
    if (vertex) {
      const std::uint32_t corner =
          entries_[nearest.entry].corner[static_cast<std::size_t>(corners_of(nearest.part)[0])];
      if (corner == e.corner[0]) weight = angle(e.b - e.a, e.c - e.a);
      if (corner == e.corner[1]) weight = angle(e.c - e.b, e.a - e.b);
      if (corner == e.corner[2]) weight = angle(e.a - e.c, e.b - e.c);
    }
    sum += weight * e.normal;
  }
  return normalized(sum);
}

void MeshTree::report(const Vec3& p, double r, double reach, MeshScratch& scratch) const {
  auto& hits = scratch.hits;
  std::sort(hits.begin(), hits.end(), [this](const MeshHit& l, const MeshHit& h) {
    return l.distance2 != h.distance2 ? l.distance2 < h.distance2
                                      : entries_[l.entry].triangle < entries_[h.entry].triangle;
  });
  const auto add = [&](const MeshHit& hit, double distance, const Vec3& normal) {
    scratch.touches.push_back(
        {{distance, normal}, std::uint64_t{entries_[hit.entry].triangle} * 8 + static_cast<std::uint64_t>(hit.part)});
  };
  const Vec3 out = outward(hits[0], hits);
  const double nearest = std::sqrt(hits[0].distance2);
  // On the surface itself only the surface knows a direction.
  const bool on_surface = nearest < 1e-9 * r;
  if (on_surface) return add(hits[0], 0.0, out);
  if (closed_ && dot(p - hits[0].point, out) < 0.0) return add(hits[0], -nearest, (hits[0].point - p) / nearest);

  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double distance = std::sqrt(hits[i].distance2);
    if (distance >= r + reach) break;
    if (!is_local_minimum(hits[i], hits)) continue;
    // The far side of a thin closed mesh is not touched through the near one.
    const bool behind = dot(p - hits[i].point, entries_[hits[i].entry].normal) < 0.0;
    if (closed_ && behind && hits[i].part == TrianglePart::face) continue;
    const double same = kSamePoint * std::max(r, distance);
    const bool known = std::any_of(scratch.touches.begin(), scratch.touches.end(), [&](const MeshTouch& touch) {
      const Vec3 point = p - touch.nearest.distance * touch.nearest.normal;
      return squared_norm(point - hits[i].point) <= same * same;
    });
    if (!known) add(hits[i], distance, (p - hits[i].point) / distance);
  }
}

void MeshTree::touch(const Vec3& p, double r, double reach, MeshScratch& scratch) const {
  scratch.touches.clear();
  collect(p, r + reach, scratch.hits);
  if (scratch.hits.empty() && closed_) collect(p, 2.0 * r, scratch.hits);
  if (scratch.hits.empty() && bounded_ && encloses(p)) {
    const double most = norm(nodes_[0].box.upper - nodes_[0].box.lower);
    for (double radius = std::max(4.0 * r, 1e-3 * most); scratch.hits.empty() && radius < 4.0 * most; radius *= 2.0) {
      collect(p, radius, scratch.hits);
    }
  }
  if (!scratch.hits.empty()) report(p, r, reach, scratch);
}

}  // namespace scree::sphere_cluster
