// TriangleTree: a balanced tree of boxes over the triangles of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// Nodes in the order of their depth-first walk, split at the median of the longest side.
class TriangleTree {
 public:
  /// A node covers the triangles [begin, end) of order(); children follow: left at index + 1, right at `right`, which is 0
  /// in a leaf.
  struct Node {
    Aabb box;
    std::uint32_t begin = 0, end = 0, right = 0;
  };
  /// Levels that any mesh fits into, for stacks of walks: 32-bit indices, halved at each level.
  static constexpr std::size_t kMostLevels = 64;

  /// @param mesh at least one triangle, indices in range, finite vertices; not kept.
  explicit TriangleTree(const TriangleMesh& mesh);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls `look(triangle)` for the triangles of all leaves whose box meets `box`; it returns false to end the walk.
  template <class Look>
  void visit(const Aabb& box, Look&& look) const {
    std::array<std::uint32_t, kMostLevels> stack{};
    std::size_t depth = 1;
    while (depth > 0) {
      const std::uint32_t index = stack[--depth];
      const Node& node = nodes_[index];
      if (!overlap(node.box, box)) continue;
      if (node.right != 0) {
        stack[depth++] = node.right;
        stack[depth++] = index + 1;
        continue;
      }
      for (std::uint32_t k = node.begin; k < node.end; ++k) {
        if (!look(order_[k])) return;
      }
    }
  }

 private:
  std::uint32_t build(const TriangleMesh& mesh, std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace scree
