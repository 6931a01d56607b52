#include "scree/geometry/mesh_edges.hpp"

#include <algorithm>
#include <tuple>

namespace scree {

std::vector<MeshSide> sorted_sides(const TriangleMesh& mesh) {
  std::vector<MeshSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1u) % 3u];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(i), k, a < b});
    }
  }
  std::ranges::sort(sides, {}, [](const MeshSide& s) { return std::tuple{s.low, s.high, s.triangle}; });
  return sides;
}

}  // namespace scree
