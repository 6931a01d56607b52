#include <algorithm>
#include <limits>
#include <map>

#include "scree/base/error.hpp"
#include "scree/geometry/signed_distance.hpp"

namespace scree {
namespace {

double squared_distance(const Aabb& box, const Vec3& p) {
  const auto beyond = [](double low, double high, double x) { return std::max({low - x, x - high, 0.0}); };
  return squared_norm(Vec3{beyond(box.lower.x, box.upper.x, p.x), beyond(box.lower.y, box.upper.y, p.y),
                           beyond(box.lower.z, box.upper.z, p.z)});
}

/// The mesh, if it is a solid.
TriangleMesh solid_mesh(TriangleMesh mesh) {
  if (const std::string problem = check_mesh(mesh).problem(); !problem.empty()) {
    throw Error{ErrorKind::usage, "the mesh does not bound a solid: " + problem};
  }
  return mesh;
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh) : mesh_{solid_mesh(std::move(mesh))}, tree_{mesh_} { compute_normals(); }

void MeshDistance::compute_normals() {
  vertex_normals_.assign(mesh_.vertices.size(), {});
  triangle_normals_.resize(mesh_.triangles.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> edges;
  const auto edge_key = [](std::uint32_t a, std::uint32_t b) { return std::pair{std::min(a, b), std::max(a, b)}; };
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const Triangle& t = mesh_.triangles[i];
    const Vec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    const Vec3 normal = normalized(cross(b - a, c - a));
    triangle_normals_[i][3] = normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& at = mesh_.vertices[t[k]];
      const Vec3 next = mesh_.vertices[t[(k + 1) % 3]] - at, last = mesh_.vertices[t[(k + 2) % 3]] - at;
      vertex_normals_[t[k]] += std::atan2(norm(cross(next, last)), dot(next, last)) * normal;
      edges[edge_key(t[k], t[(k + 1) % 3])] += normal;
    }
  }
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const Triangle& t = mesh_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) triangle_normals_[i][k] = edges[edge_key(t[k], t[(k + 1) % 3])];
  }
}

MeshDistance::Closest MeshDistance::closest(const Vec3& p) const {
  double best = std::numeric_limits<double>::infinity();
  TrianglePoint found;
  std::size_t triangle = 0;
  std::array<std::uint32_t, TriangleTree::kMostLevels> stack{};
  std::size_t depth = 0;
  stack[depth++] = 0;
  const std::vector<TriangleTree::Node>& nodes = tree_.nodes();
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const TriangleTree::Node& node = nodes[index];
    if (squared_distance(node.box, p) >= best) continue;
    if (node.right != 0) {
      const std::uint32_t left = index + 1;
      const bool left_first = squared_distance(nodes[left].box, p) < squared_distance(nodes[node.right].box, p);
      stack[depth++] = left_first ? node.right : left;
      stack[depth++] = left_first ? left : node.right;
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.end; ++k) {
      const Triangle& t = mesh_.triangles[tree_.order()[k]];
      const TrianglePoint q = closest_on_triangle(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
      if (const double squared = squared_norm(p - q.point); squared < best) {
        best = squared;
        found = q;
        triangle = tree_.order()[k];
      }
    }
  }
  const auto feature = static_cast<std::size_t>(found.feature);
  const Vec3& normal =
      feature < 3 ? vertex_normals_[mesh_.triangles[triangle][feature]] : triangle_normals_[triangle][feature - 3];
  const double sign = dot(p - found.point, normal) < 0.0 ? -1.0 : 1.0;
  return {found.point, sign * std::sqrt(best), triangle};
}

}  // namespace scree
