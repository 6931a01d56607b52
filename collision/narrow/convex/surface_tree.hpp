// SurfaceTree: the triangles of a mesh in a tree of boxes, and how they fold at their edges.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "scree/math/aabb.hpp"
#include "scree/model/shape_set.hpp"

namespace scree::convex {

/// One triangle as a contact sees it.
struct SurfaceTriangle {
  std::array<Vec3, 3> corner;           ///< mesh frame [m]
  Vec3 normal;                          ///< unit, outward
  std::array<Vec3, 3> out;              ///< across each edge, away from the triangle, in its plane; unit
  std::array<double, 3> fold{};         ///< its normal to the neighbour's: > 0 at a convex edge, pi at a free one [rad]
  std::array<std::uint32_t, 3> next{};  ///< the triangle across each edge; itself at a free one
  std::array<std::uint32_t, 3> vertex{};  ///< numbers of its corners, the same in all triangles that share them
};

/// The triangles of one mesh; those without an area are left out.
class SurfaceTree {
 public:
  SurfaceTree(const ShapeSet& shapes, const Primitive& mesh);

  [[nodiscard]] const SurfaceTriangle& triangle(std::uint32_t i) const { return triangle_[i]; }
  [[nodiscard]] std::size_t size() const { return triangle_.size(); }
  /// Every edge has two triangles: the mesh has an inside.
  [[nodiscard]] bool closed() const { return closed_; }
  /// Holds them all [m]; nothing where there are none.
  [[nodiscard]] Aabb box() const { return node_.empty() ? Aabb::empty() : node_[0].box; }
  /// Appends the triangles whose boxes meet `box` [m], in increasing order.
  void find(const Aabb& box, std::vector<std::uint32_t>& out) const;
  /// True when a contact with normal n, a unit vector away from the surface on the side of `side` times the triangle's normal,
  /// is one of the surface: the part of the triangle that is farthest along n is its face, or an edge and n points between the
  /// normals of both triangles, or a corner and no edge rises along n.
  [[nodiscard]] bool owns(std::uint32_t i, const Vec3& n, double side) const;

 private:
  void find_folds(const std::vector<Triangle>& corners);
  void build(std::size_t node, std::size_t first, std::size_t last);

  struct Node {
    Aabb box;
    std::uint32_t first = 0, last = 0;  // of order_, of a leaf
    std::uint32_t right = 0;            // second child; 0 for a leaf; the first one follows
  };
  std::vector<SurfaceTriangle> triangle_;
  std::vector<Vec3> rays_;                                          // along the edges that leave each vertex; unit
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> rays_of_;  // by vertex number
  std::vector<std::uint32_t> order_;
  std::vector<Node> node_;
  bool closed_ = true;
};

}  // namespace scree::convex
