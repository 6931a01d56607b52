#include "scree/geometry/triangle_tree.hpp"

#include <algorithm>
#include <numeric>

#include "scree/base/require.hpp"

namespace scree {
namespace {

constexpr std::uint32_t kLeafSize = 4;

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : order_(mesh.triangles.size()) {
  SCREE_REQUIRE(!mesh.triangles.empty(), "TriangleTree: the mesh has no triangle");
  std::iota(order_.begin(), order_.end(), 0u);
  build(mesh, 0, static_cast<std::uint32_t>(order_.size()));
}

std::uint32_t TriangleTree::build(const TriangleMesh& mesh, std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Aabb box = Aabb::empty();
  for (std::uint32_t k = begin; k < end; ++k) {
    for (const std::uint32_t v : mesh.triangles[order_[k]]) box = merged(box, mesh.vertices[v]);
  }
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= kLeafSize) return index;

  const Vec3 extent = box.upper - box.lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const auto key = [&](std::uint32_t t) {
    const Triangle& corners = mesh.triangles[t];
    return mesh.vertices[corners[0]][axis] + mesh.vertices[corners[1]][axis] + mesh.vertices[corners[2]][axis];
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  build(mesh, begin, middle);
  const std::uint32_t right = build(mesh, middle, end);
  nodes_[index].right = right;
  return index;
}

}  // namespace scree
