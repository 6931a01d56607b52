#include "scree/geometry/closest_triangle.hpp"

#include <algorithm>
#include <array>

namespace scree {
namespace {

double squared_distance(const Aabb& box, const Vec3& p) {
  const auto beyond = [](double low, double high, double x) { return std::max({low - x, x - high, 0.0}); };
  return squared_norm(Vec3{beyond(box.lower.x, box.upper.x, p.x), beyond(box.lower.y, box.upper.y, p.y),
                           beyond(box.lower.z, box.upper.z, p.z)});
}

}  // namespace

NearTriangle closest_triangle(const TriangleMesh& mesh, const TriangleTree& tree, const Vec3& p) {
  NearTriangle best;
  std::array<std::uint32_t, TriangleTree::kMostLevels> stack{};
  std::size_t depth = 0;
  stack[depth++] = 0;
  const std::vector<TriangleTree::Node>& nodes = tree.nodes();
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const TriangleTree::Node& node = nodes[index];
    if (squared_distance(node.box, p) >= best.squared_distance) continue;
    if (node.right != 0) {
      const std::uint32_t left = index + 1;
      const bool left_first = squared_distance(nodes[left].box, p) < squared_distance(nodes[node.right].box, p);
      stack[depth++] = left_first ? node.right : left;
      stack[depth++] = left_first ? left : node.right;
      continue;
    }
    for (std::uint32_t k = node.begin; k < node.end; ++k) {
      const Triangle& t = mesh.triangles[tree.order()[k]];
      const TrianglePoint q = closest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
      if (const double squared = squared_norm(p - q.point); squared < best.squared_distance) {
        best = {tree.order()[k], q, squared};
      }
    }
  }
  return best;
}

}  // namespace scree
