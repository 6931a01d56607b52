#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "scree/base/error.hpp"
#include "scree/geometry/signed_distance.hpp"

namespace scree {
namespace {

constexpr std::uint32_t kLeafSize = 4;

double squared_distance(const Aabb& box, const Vec3& p) {
  const auto beyond = [](double low, double high, double x) { return std::max({low - x, x - high, 0.0}); };
  return squared_norm(Vec3{beyond(box.lower.x, box.upper.x, p.x), beyond(box.lower.y, box.upper.y, p.y),
                           beyond(box.lower.z, box.upper.z, p.z)});
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh) : mesh_{std::move(mesh)} {
  if (const std::string problem = check_mesh(mesh_).problem(); !problem.empty()) {
    throw Error{ErrorKind::usage, "the mesh does not bound a solid: " + problem};
  }
  order_.resize(mesh_.triangles.size());
  std::iota(order_.begin(), order_.end(), 0u);
  build(0, static_cast<std::uint32_t>(order_.size()));
  compute_normals();
}

std::uint32_t MeshDistance::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Aabb box = Aabb::empty();
  for (std::uint32_t k = begin; k < end; ++k) {
    for (const std::uint32_t v : mesh_.triangles[order_[k]]) box = merged(box, mesh_.vertices[v]);
  }
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeafSize) return index;

  const Vec3 extent = box.upper - box.lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const auto key = [&](std::uint32_t t) {
    const Triangle& corners = mesh_.triangles[t];
    return mesh_.vertices[corners[0]][axis] + mesh_.vertices[corners[1]][axis] + mesh_.vertices[corners[2]][axis];
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[index].right = right;
  return index;
}

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
  std::array<std::uint32_t, 64> stack{};  // the tree is balanced: 64 levels hold any mesh
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    if (squared_distance(node.box, p) >= best) continue;
    if (node.right != 0) {
      const std::uint32_t left = index + 1;
      const bool left_first = squared_distance(nodes_[left].box, p) < squared_distance(nodes_[node.right].box, p);
      stack[depth++] = left_first ? node.right : left;
      stack[depth++] = left_first ? left : node.right;
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.end; ++k) {
      const Triangle& t = mesh_.triangles[order_[k]];
      const TrianglePoint q = closest_on_triangle(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
      if (const double squared = squared_norm(p - q.point); squared < best) {
        best = squared;
        found = q;
        triangle = order_[k];
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
