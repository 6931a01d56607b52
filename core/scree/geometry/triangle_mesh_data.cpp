#include "scree/geometry/triangle_mesh_data.hpp"

#include <algorithm>
#include <numbers>
#include <unordered_map>

#include "scree/base/require.hpp"
#include "scree/geometry/mesh_edges.hpp"

namespace scree {
namespace {

/// Counts faulty edges; returns the number of edges.
std::size_t count_edges(const TriangleMesh& mesh, MeshReport& report) {
  std::size_t edges = 0;
  for_each_edge(sorted_sides(mesh), [&](std::span<const MeshSide> edge) {
    ++edges;
    if (edge.size() == 1) ++report.open_edges;
    if (edge.size() > 2) ++report.crowded_edges;
    if (edge.size() == 2 && edge[0].upwards == edge[1].upwards) ++report.misoriented_edges;
  });
  return edges;
}

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t hash = 0;
    for (const std::int64_t part : c) hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15u;
    return hash;
  }
};

std::size_t count_used_vertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  return static_cast<std::size_t>(std::ranges::count(used, true));
}

/// Tells triangles without an area from others.
class AreaCheck {
 public:
  explicit AreaCheck(const TriangleMesh& mesh) : mesh_{mesh} {
    const Aabb box = bounds_of(mesh.vertices);
    middle_ = 0.5 * (box.lower + box.upper);
    least_ = 1e-14 * squared_norm(box.upper - box.lower);
  }
  [[nodiscard]] const Vec3& middle() const { return middle_; }
  [[nodiscard]] bool is_degenerate(const Triangle& t) const {
    const Vec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    return !(0.5 * norm(cross(b - a, c - a)) > least_);
  }

 private:
  const TriangleMesh& mesh_;
  Vec3 middle_;
  double least_;  // area [m^2]
};

}  // namespace

MeshReport check_mesh(const TriangleMesh& mesh) {
  MeshReport report;
  report.bad_vertices =
      static_cast<std::size_t>(std::ranges::count_if(mesh.vertices, [](const Vec3& v) { return !is_finite(v); }));
  report.bad_indices = static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, [&](const Triangle& t) {
    return std::ranges::any_of(t, [&](std::uint32_t v) { return v >= mesh.vertices.size(); });
  }));
  if (report.bad_vertices + report.bad_indices > 0 || mesh.triangles.empty()) return report;

  const AreaCheck area{mesh};
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - area.middle(), b = mesh.vertices[t[1]] - area.middle();
    if (area.is_degenerate(t)) ++report.degenerate_triangles;
    report.volume += dot(a, cross(b, mesh.vertices[t[2]] - area.middle())) / 6.0;
  }
  const std::size_t edges = count_edges(mesh, report);
  report.euler =
      static_cast<int>(count_used_vertices(mesh)) - static_cast<int>(edges) + static_cast<int>(mesh.triangles.size());
  report.inside_out = report.is_closed() && report.is_oriented() && report.volume < 0.0;
  return report;
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh without_degenerate(TriangleMesh mesh) {
  const AreaCheck area{mesh};
  std::vector<Triangle> kept;
  for (const Triangle& t : mesh.triangles) {
    if (!area.is_degenerate(t)) kept.push_back(t);
  }
  mesh.triangles = std::move(kept);
  return mesh;
}

TriangleMesh welded(const TriangleMesh& mesh, double distance) {
  SCREE_REQUIRE(distance >= 0.0, "welded(): the distance must not be negative");
  const Aabb box = bounds_of(mesh.vertices);
  const double edge = std::max(2.0 * distance, 1e-9 * norm(box.upper - box.lower));
  const auto cell_of = [&](const Vec3& v) {
    const Vec3 scaled = (v - box.lower) / (edge > 0.0 ? edge : 1.0);
    return Cell{std::llround(scaled.x), std::llround(scaled.y), std::llround(scaled.z)};
  };

  // The first of the vertices that lie together stands for all of them; it is found in its cell or in one beside it.
  TriangleMesh result;
  std::unordered_multimap<Cell, std::uint32_t, CellHash> cells;
  std::vector<std::uint32_t> new_index;
  for (const Vec3& v : mesh.vertices) {
    const Cell cell = cell_of(v);
    auto match = static_cast<std::uint32_t>(result.vertices.size());
    for (int k = 0; k < 27; ++k) {
      const auto [begin, end] = cells.equal_range({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
      for (auto it = begin; it != end; ++it) {
        const Vec3 d = v - result.vertices[it->second];
        const double furthest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        if (furthest <= distance) match = std::min(match, it->second);
      }
    }
    if (match == result.vertices.size()) {
      result.vertices.push_back(v);
      cells.emplace(cell, match);
    }
    new_index.push_back(match);
  }
  for (const Triangle& t : mesh.triangles) {
    const Triangle n{new_index[t[0]], new_index[t[1]], new_index[t[2]]};
    if (n[0] != n[1] && n[1] != n[2] && n[2] != n[0]) result.triangles.push_back(n);
  }
  return result;
}

Aabb bounds_of(std::span<const Vec3> points) {
  Aabb box = Aabb::empty();
  for (const Vec3& p : points) box = merged(box, p);
  return box;
}

TriangleMesh box_mesh(const Vec3& half_lengths) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {  // bits of the corner's number: x, y, z on the upper side
    mesh.vertices.push_back({(corner & 1) ? half_lengths.x : -half_lengths.x,
                             (corner & 2) ? half_lengths.y : -half_lengths.y,
                             (corner & 4) ? half_lengths.z : -half_lengths.z});
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

TriangleMesh cylinder_mesh(double radius, double half_length, int sides) {
  SCREE_REQUIRE(sides >= 3, "cylinder_mesh(): a rim needs at least 3 corners");
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), -half_length});
    mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), half_length});
  }
  mesh.vertices.push_back({0, 0, -half_length});
  mesh.vertices.push_back({0, 0, half_length});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t low = 2 * i, next_low = 2 * ((i + 1) % n);
    mesh.triangles.push_back({low, next_low, next_low + 1});
    mesh.triangles.push_back({low, next_low + 1, low + 1});
    mesh.triangles.push_back({2 * n, next_low, low});
    mesh.triangles.push_back({2 * n + 1, low + 1, next_low + 1});
  }
  return mesh;
}

}  // namespace scree
