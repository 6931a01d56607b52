#include "mesh_surface.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "simplex.hpp"

namespace scree::polyhedron {
namespace {

constexpr std::uint32_t kLeafSize = 4;
/// Sine of the angle by which a surface may rise and still count as level: rounding, and no more, or planes would get bumps.
constexpr double kLevel = 1e-6;

Vec3 sum_of_corners(const MeshTriangle& t) { return t.corner[0] + t.corner[1] + t.corner[2]; }

/// A side of a triangle as it is passed, with the corner opposite to it.
struct Pass {
  std::uint32_t from, to, opposite;
  std::uint32_t triangle, edge;
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> ends() const { return std::minmax(from, to); }
};

}  // namespace

MeshSurface::MeshSurface(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  weld(vertices, triangles);
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
  connect();
  if (nodes_.empty()) return;
  middle_ = 0.5 * (nodes_[0].box.lower + nodes_[0].box.upper);
  for (const Vec3& corner : places_) size_ = std::max(size_, norm(corner - middle_));
}

void MeshSurface::weld(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> order;
  for (const Triangle& t : triangles) order.insert(order.end(), t.begin(), t.end());
  const auto key = [&](std::uint32_t i) { return std::tuple{vertices[i].x, vertices[i].y, vertices[i].z}; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t l, std::uint32_t r) { return key(l) < key(r); });
  for (const std::uint32_t i : order) {
    if (places_.empty() || !(places_.back() == vertices[i])) places_.push_back(vertices[i]);
  }
  const auto place = [&](std::uint32_t i) {
    const auto at = std::lower_bound(places_.begin(), places_.end(), vertices[i], [](const Vec3& l, const Vec3& r) {
      return std::tuple{l.x, l.y, l.z} < std::tuple{r.x, r.y, r.z};
    });
    return static_cast<std::uint32_t>(at - places_.begin());
  };
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto& [i, j, l] = triangles[k];
    const Vec3 area = cross(vertices[j] - vertices[i], vertices[l] - vertices[i]);
    if (!(norm(area) > 0.0)) continue;
    triangles_.push_back({{vertices[i], vertices[j], vertices[l]},
                          normalized(area),
                          {place(i), place(j), place(l)},
                          {kNoPlace, kNoPlace, kNoPlace},
                          static_cast<std::uint32_t>(k)});
  }
}

void MeshSurface::connect() {
  std::vector<Pass> passes;
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const auto& p = triangles_[i].place;
    for (std::uint32_t k = 0; k < 3; ++k) passes.push_back({p[k], p[(k + 1) % 3], p[(k + 2) % 3], i, k});
  }
  std::sort(passes.begin(), passes.end(), [](const Pass& l, const Pass& r) {
    return std::tuple{l.ends(), l.triangle, l.edge} < std::tuple{r.ends(), r.triangle, r.edge};
  });
  closed_ = !passes.empty();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  for (std::size_t k = 0; k < passes.size();) {
    std::size_t end = k + 1;
    while (end < passes.size() && passes[end].ends() == passes[k].ends()) ++end;
    closed_ = closed_ && end - k == 2 && passes[k].from == passes[k + 1].to;
    for (std::size_t i = k; i < end; ++i) {
      // Where more than two triangles meet, the next one stands for the others.
      const Pass& next = passes[i + 1 < end ? i + 1 : k];
      if (end - k > 1) triangles_[passes[i].triangle].across[passes[i].edge] = next.opposite;
    }
    links.emplace_back(passes[k].from, passes[k].to);
    links.emplace_back(passes[k].to, passes[k].from);
    k = end;
  }
  std::sort(links.begin(), links.end());
  first_neighbour_.assign(places_.size() + 1, 0);
  for (const auto& [from, to] : links) {
    ++first_neighbour_[from + 1];
    neighbours_.push_back(to);
  }
  std::partial_sum(first_neighbour_.begin(), first_neighbour_.end(), first_neighbour_.begin());
}

void MeshSurface::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t at = nodes_.size();
  Aabb box = Aabb::empty(), middles = Aabb::empty();
  for (std::uint32_t i = first; i < last; ++i) {
    for (const Vec3& corner : triangles_[i].corner) box = merged(box, corner);
    middles = merged(middles, sum_of_corners(triangles_[i]));
  }
  nodes_.push_back({box, 0, first, last - first});
  if (last - first > kLeafSize) {
    nodes_[at].count = 0;
    const Vec3 extent = middles.upper - middles.lower;
    const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
    const std::uint32_t half = first + (last - first) / 2;
    const auto begin = triangles_.begin();
    std::nth_element(begin + first, begin + half, begin + last, [axis](const MeshTriangle& l, const MeshTriangle& r) {
      const double ml = sum_of_corners(l)[axis], mr = sum_of_corners(r)[axis];
      return ml != mr ? ml < mr : l.number < r.number;
    });
    build(first, half);
    build(half, last);
  }
  nodes_[at].skip = static_cast<std::uint32_t>(nodes_.size());
}

void MeshSurface::near(const Aabb& box, std::vector<std::uint32_t>& out) const {
  out.clear();
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    if (!overlap(node.box, box)) {
      n = node.skip;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& [a, b, c] = triangles_[i].corner;
      if (overlap(merged(merged(Aabb{a, a}, b), c), box)) out.push_back(i);
    }
    ++n;
  }
}

/// Whether the ray along x from a point passes a triangle. Both triangles of an edge ask about it in the same words, so that one of
/// them has it, whatever rounding says.
bool MeshSurface::is_passed(const MeshTriangle& t, const Vec3& point) const {
  const auto left_of = [&](std::size_t k) {
    const auto [low, high] = std::minmax(t.place[k], t.place[(k + 1) % 3]);
    const Vec3 from = places_[low] - point, to = places_[high] - point;
    const bool left = from.y * to.z - from.z * to.y >= 0.0;
    return left == (low == t.place[k]);
  };
  if (left_of(0) != left_of(1) || left_of(1) != left_of(2)) return false;
  return dot(t.normal, t.corner[0] - point) * t.normal.x > 0.0;
}

bool MeshSurface::holds(const Vec3& point) const {
  if (!closed_ || !contains(nodes_[0].box, point)) return false;
  const Aabb ray{point, {nodes_[0].box.upper.x, point.y, point.z}};
  bool inside = false;
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    if (!overlap(node.box, ray)) {
      n = node.skip;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      inside = inside != is_passed(triangles_[i], point);
    ++n;
  }
  return inside;
}

std::uint32_t MeshSurface::nearest(const Vec3& point) const {
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    Simplex simplex;
    for (std::uint32_t k = 0; k < 3; ++k) simplex.add({triangles_[i].corner[k] - point, {}, k, k});
    const double d2 = squared_norm(simplex.reduce(true));
    if (d2 >= least) continue;
    least = d2;
    best = i;
  }
  return best;
}

bool MeshSurface::below(std::uint32_t place, const Vec3& from, const Vec3& m) const {
  const Vec3 way = places_[place] - from;
  const double rise = dot(m, way);
  return rise <= 0.0 || rise * rise <= kLevel * kLevel * squared_norm(way);
}

bool MeshSurface::corner_admits(const MeshTriangle& t, std::size_t k, const Vec3& m) const {
  const std::uint32_t place = t.place[k];
  for (std::uint32_t i = first_neighbour_[place]; i < first_neighbour_[place + 1]; ++i) {
    if (!below(neighbours_[i], places_[place], m)) return false;
  }
  return true;
}

bool MeshSurface::edge_admits(const MeshTriangle& t, std::size_t k, const Vec3& m) const {
  const Vec3& from = t.corner[k];
  return below(t.place[(k + 2) % 3], from, m) && (t.across[k] == kNoPlace || below(t.across[k], from, m));
}

}  // namespace scree::polyhedron
