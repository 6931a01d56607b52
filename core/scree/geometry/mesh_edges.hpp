// The edges of a mesh, with the triangles on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// One side of a triangle.
struct MeshSide {
  std::uint32_t low, high;  ///< its ends, vertices, in ascending order
  std::uint32_t triangle;   ///< that it belongs to
  std::uint8_t corner;      ///< it runs from this corner of the triangle to the next
  bool upwards;             ///< the triangle passes it from low to high
};

/// All sides, those of one edge together, edges in ascending order of their ends. Indices in range are not needed.
[[nodiscard]] std::vector<MeshSide> sorted_sides(const TriangleMesh& mesh);

/// Calls `visit(std::span<const MeshSide>)` for each edge: the sides that lie on it.
template <class Visit>
void for_each_edge(std::span<const MeshSide> sides, Visit&& visit) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    visit(sides.subspan(begin, end - begin));
  }
}

}  // namespace scree
