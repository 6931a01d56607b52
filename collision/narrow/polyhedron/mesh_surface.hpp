// MeshSurface: a triangle mesh, ready to be asked which of its triangles are near a box, and along which directions an edge or
// a corner of it can be touched at all.
//
// On a finely triangulated plane most edges are no edges of the surface. An edge or a corner is touched along m only when
// it is the highest part of the surface along m among its neighbours, that is when m lies in its normal cone; for an edge
// of a plane these are the plane's own normals, for a valley none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scree/math/aabb.hpp"
#include "scree/model/shape_set.hpp"

namespace scree::polyhedron {

/// A triangle of a mesh [m], mesh frame.
struct MeshTriangle {
  std::array<Vec3, 3> corner;
  Vec3 normal;                         ///< unit, to where the corners turn counter-clockwise [1]
  std::array<std::uint32_t, 3> place;  ///< welded corners
  std::array<std::uint32_t, 3>
      across;                ///< welded corner opposite to each edge k, k + 1 in the neighbour; kNoPlace at a rim
  std::uint32_t number = 0;  ///< in the shape
};

inline constexpr std::uint32_t kNoPlace = 0xffffffff;

/// The triangles of a mesh with a tree over them.
class MeshSurface {
 public:
  /// `triangles` index `vertices` [m]. Vertices at the same place are one; triangles without area are left out.
  MeshSurface(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  /// Triangles whose box meets `box` [m], as indices for operator[], in the order of the tree.
  void near(const Aabb& box, std::vector<std::uint32_t>& out) const;
  [[nodiscard]] const MeshTriangle& operator[](std::uint32_t i) const { return triangles_[i]; }
  /// The corners of its triangles [m], each once.
  [[nodiscard]] std::span<const Vec3> corners() const { return places_; }
  /// Middle [m] and radius [m] of a ball that holds them.
  [[nodiscard]] const Vec3& middle() const { return middle_; }
  [[nodiscard]] double size() const { return size_; }

  /// Whether a point [m] lies inside of a closed mesh: how often a ray from it passes the surface.
  [[nodiscard]] bool holds(const Vec3& point) const;
  /// The triangle nearest to a point [m]; the mesh has some.
  [[nodiscard]] std::uint32_t nearest(const Vec3& point) const;

  /// True when the surface about corner k of a triangle does not rise above it along m.
  [[nodiscard]] bool corner_admits(const MeshTriangle& t, std::size_t k, const Vec3& m) const;
  /// The same for the edge from corner k to the next one.
  [[nodiscard]] bool edge_admits(const MeshTriangle& t, std::size_t k, const Vec3& m) const;
  /// Every edge has two triangles of opposite sense: the mesh has an inside.
  [[nodiscard]] bool closed() const { return closed_; }

 private:
  struct Node {
    Aabb box;
    std::uint32_t skip;          // node after this subtree
    std::uint32_t first, count;  // triangles of a leaf
  };
  void weld(std::span<const Vec3> vertices, std::span<const Triangle> triangles);
  void connect();
  void build(std::uint32_t first, std::uint32_t last);
  [[nodiscard]] bool is_passed(const MeshTriangle& t, const Vec3& point) const;
  [[nodiscard]] bool below(std::uint32_t place, const Vec3& from, const Vec3& m) const;

  std::vector<MeshTriangle> triangles_;  // in the order of the tree
  std::vector<Node> nodes_;
  std::vector<Vec3> places_;                    // [m]
  std::vector<std::uint32_t> first_neighbour_;  // of each place, one more at the end
  std::vector<std::uint32_t> neighbours_;
  Vec3 middle_;
  double size_ = 0.0;
  bool closed_ = false;
};

}  // namespace scree::polyhedron
