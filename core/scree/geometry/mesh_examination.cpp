#include "scree/geometry/mesh_examination.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "scree/geometry/mesh_edges.hpp"
#include "scree/geometry/triangle_crossing.hpp"
#include "scree/geometry/triangle_tree.hpp"

namespace scree {
namespace {

TriangleCorners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Looks for pairs of triangles that pass through each other, in a mesh of extent 1 about the origin.
class CrossingSearch {
 public:
  CrossingSearch(const TriangleMesh& unit, std::span<const MeshSide> sides) : mesh_{unit}, tree_{unit} {
    boxes_.reserve(mesh_.triangles.size());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) boxes_.push_back(bounds_of(corners_of(mesh_, t)));
    across_.assign(3 * mesh_.triangles.size(), kNone);
    for_each_edge(sides, [&](std::span<const MeshSide> edge) {
      if (edge.size() != 2) return;
      across_[3 * edge[0].triangle + edge[0].corner] = edge[1].triangle;
      across_[3 * edge[1].triangle + edge[1].corner] = edge[0].triangle;
    });
  }

  void run(MeshReport& report) const {
    for (std::uint32_t a = 0; a < mesh_.triangles.size() && report.crossings < kMostCrossings; ++a) {
      const TriangleCorners corners = corners_of(mesh_, a);
      const Aabb near = expanded(boxes_[a], kTouching);
      tree_.visit(near, [&](std::uint32_t b) {
        if (!overlap(boxes_[b], near)) return true;
        const std::optional<Vec3> at = crossing(a, corners, b);
        if (at && report.crossings++ == 0) report.crossing_at = *at;
        return report.crossings < kMostCrossings;
      });
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Of a pair, seen once: by the triangle with the smaller index, but for edges in faces, which have one.
  [[nodiscard]] std::optional<Vec3> crossing(std::uint32_t a, const TriangleCorners& corners, std::uint32_t b) const {
    const Triangle &ta = mesh_.triangles[a], &tb = mesh_.triangles[b];
    if (a == b) return {};
    const auto in_a = [&](std::uint32_t v) { return std::ranges::find(ta, v) != ta.end(); };
    const auto shared = std::ranges::count_if(tb, in_a);
    if (shared >= 2) return a < b ? fold(ta, tb, static_cast<int>(shared)) : std::nullopt;
    if (a < b) {
      if (const std::optional<Vec3> at = crossing_of(corners, corners_of(mesh_, b), kTouching)) return at;
    }
    return shared == 0 ? edge_in_face(corners, b) : std::nullopt;
  }

  /// Triangles with a common edge, or with all corners in common.
  [[nodiscard]] std::optional<Vec3> fold(const Triangle& ta, const Triangle& tb, int shared) const {
    if (shared == 3) return mesh_.vertices[ta[0]];
    std::size_t off = 0;  // the corner of a that b does not have
    while (off < 3 && std::ranges::find(tb, ta[off]) != tb.end()) ++off;
    if (off == 3) return {};  // names a corner twice
    const TriangleCorners turned{mesh_.vertices[ta[(off + 1) % 3]], mesh_.vertices[ta[(off + 2) % 3]],
                                 mesh_.vertices[ta[off]]};
    const auto third = std::ranges::find_if(tb, [&](std::uint32_t v) { return std::ranges::find(ta, v) == ta.end(); });
    if (third == tb.end() || !is_folded(turned, mesh_.vertices[*third], kTouching)) return {};
    return 0.5 * (turned[0] + turned[1]);
  }

  /// An edge of b, with its neighbour there, through the face a.
  [[nodiscard]] std::optional<Vec3> edge_in_face(const TriangleCorners& face, std::uint32_t b) const {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t neighbour = across_[3 * b + k];
      if (neighbour == kNone || neighbour < b) continue;
      const Triangle &tb = mesh_.triangles[b], &tn = mesh_.triangles[neighbour];
      const std::uint32_t from = tb[k], to = tb[(k + 1) % 3];
      const auto off = std::ranges::find_if(tn, [&](std::uint32_t v) { return v != from && v != to; });
      if (off == tn.end()) continue;
      const std::optional<Vec3> at = edge_crossing_of(face, {mesh_.vertices[from], mesh_.vertices[to]},
                                                      mesh_.vertices[tb[(k + 2) % 3]], mesh_.vertices[*off], kTouching);
      if (at) return at;
    }
    return {};
  }

  const TriangleMesh& mesh_;
  TriangleTree tree_;
  std::vector<Aabb> boxes_;            // of each triangle
  std::vector<std::uint32_t> across_;  // the triangle beyond side k of triangle t, at 3 t + k
};

/// Joins triangles over their edges, and knows which of them would have to be turned to agree.
class ShellFinder {
 public:
  explicit ShellFinder(std::size_t triangles) : parent_(triangles), turned_(triangles, 0), size_(triangles, 1) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// False when the two triangles are joined already in the other sense.
  bool join(std::uint32_t a, std::uint32_t b, bool opposite) {
    auto [root_a, turn_a] = find(a);
    auto [root_b, turn_b] = find(b);
    const bool turn = (turn_a != turn_b) != opposite;
    if (root_a == root_b) return !turn;
    if (size_[root_a] < size_[root_b]) std::swap(root_a, root_b);
    parent_[root_b] = root_a;
    size_[root_a] += size_[root_b];
    turned_[root_b] = turn ? 1 : 0;
    return true;
  }

  /// The triangle that stands for the shell, and whether t is turned against it.
  [[nodiscard]] std::pair<std::uint32_t, bool> find(std::uint32_t t) const {
    bool turn = false;
    for (; parent_[t] != t; t = parent_[t]) turn = turn != (turned_[t] != 0);
    return {t, turn};
  }

 private:
  std::vector<std::uint32_t> parent_;  // by size, so that the way to the root is short
  std::vector<char> turned_;
  std::vector<std::uint32_t> size_;
};

/// The triangles of each shell.
std::vector<std::vector<std::uint32_t>> find_shells(const TriangleMesh& mesh, std::span<const MeshSide> sides,
                                                    MeshReport& report) {
  ShellFinder finder{mesh.triangles.size()};
  for_each_edge(sides, [&](std::span<const MeshSide> edge) {
    for (std::size_t k = 1; k < edge.size(); ++k) {
      const bool agrees = finder.join(edge[0].triangle, edge[k].triangle, edge[0].upwards == edge[k].upwards);
      if (edge.size() == 2 && !agrees) report.one_sided = true;
    }
  });
  std::vector<std::vector<std::uint32_t>> shells;
  constexpr std::uint32_t kNew = 0xffffffffu;
  std::vector<std::uint32_t> number(mesh.triangles.size(), kNew);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t root = finder.find(t).first;
    if (number[root] == kNew) {
      number[root] = static_cast<std::uint32_t>(shells.size());
      shells.emplace_back();
    }
    shells[number[root]].push_back(t);
  }
  return shells;
}

/// Winding number of p about some triangles: the sum of their solid angles (van Oosterom and Strackee, 1983).
double winding_number(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles, const Vec3& p) {
  double sum = 0.0;
  for (const std::uint32_t t : triangles) {
    const TriangleCorners c = corners_of(mesh, t);
    const Vec3 a = c[0] - p, b = c[1] - p, d = c[2] - p;
    const double la = norm(a), lb = norm(b), ld = norm(d);
    sum += std::atan2(dot(a, cross(b, d)), la * lb * ld + dot(a, b) * ld + dot(b, d) * la + dot(d, a) * lb);
  }
  return sum / (2.0 * std::numbers::pi);
}

/// Counts the shells of a closed, oriented mesh that face the wrong way for where they lie.
std::size_t count_misplaced(const TriangleMesh& mesh, const std::vector<std::vector<std::uint32_t>>& shells) {
  std::vector<Aabb> boxes;
  std::vector<double> volumes;
  for (const auto& shell : shells) {
    Aabb box = Aabb::empty();
    double volume = 0.0;
    for (const std::uint32_t t : shell) {
      const TriangleCorners c = corners_of(mesh, t);
      box = merged(box, bounds_of(c));
      volume += dot(c[0], cross(c[1], c[2])) / 6.0;
    }
    boxes.push_back(box);
    volumes.push_back(volume);
  }
  std::size_t misplaced = 0;
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const TriangleCorners first = corners_of(mesh, shells[i][0]);
    const Vec3 p = (first[0] + first[1] + first[2]) / 3.0;
    double enclosed = 0.0;
    for (std::size_t j = 0; j < shells.size(); ++j) {
      if (j != i && contains(boxes[j], p)) enclosed += winding_number(mesh, shells[j], p);
    }
    // A shell that touches another from outside has half its winding number there.
    const double wanted = volumes[i] > 0.0 ? 0.0 : 1.0;
    if (std::abs(enclosed - wanted) > 0.5 + 1e-6) ++misplaced;
  }
  return misplaced;
}

}  // namespace

MeshReport examine_mesh(const TriangleMesh& mesh) {
  MeshReport report = check_mesh(mesh);
  if (report.bad_vertices + report.bad_indices > 0 || mesh.triangles.empty()) return report;
  const Aabb box = bounds_of(mesh.vertices);
  const double extent = norm(box.upper - box.lower);
  if (!(extent > 0.0) || !std::isfinite(extent)) return report;
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  TriangleMesh unit = mesh;
  for (Vec3& v : unit.vertices) v = (v - middle) / extent;

  const std::vector<MeshSide> sides = sorted_sides(mesh);
  CrossingSearch{unit, sides}.run(report);
  report.crossing_at = middle + extent * report.crossing_at;
  const auto shells = find_shells(mesh, sides, report);
  report.shells = shells.size();
  const bool nested = report.is_closed() && report.is_oriented() && report.crossings == 0 && shells.size() > 1;
  if (nested) report.misplaced_shells = count_misplaced(unit, shells);
  return report;
}

}  // namespace scree
