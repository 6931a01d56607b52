// MeshTree: a triangle mesh, ready to be asked what a sphere touches.
//
// A sphere touches a mesh where the distance from its centre has a local
// minimum over the surface: faces, convex edges and convex corners, each once.
// Triangles lie in the order of a bounding volume hierarchy, which is walked
// without a stack (every node knows where its subtree ends).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nearest.hpp"
#include "scree/math/aabb.hpp"
#include "scree/model/shape_set.hpp"
#include "triangle.hpp"

namespace scree::sphere_cluster {

/// A place where a sphere touches a mesh.
struct MeshTouch {
  Nearest nearest;
  std::uint64_t feature = 0;  ///< triangle * 8 + part
};

/// A triangle near a point, with its nearest point.
struct MeshHit {
  Vec3 point;               ///< [m], mesh frame
  double distance2 = 0.0;   ///< [m2]
  std::uint32_t entry = 0;  ///< position in the tree's order
  TrianglePart part = TrianglePart::face;
};

/// Buffers of a query, kept by the caller.
struct MeshScratch {
  std::vector<MeshHit> hits;
  std::vector<MeshTouch> touches;
};

/// The triangles of a mesh and a tree over them.
class MeshTree {
 public:
  /// `triangles` index `vertices` [m]. Vertices at the same place count as one;
  /// triangles without area are left out.
  MeshTree(std::span<const Vec3> vertices, std::span<const Triangle> triangles);

  /// Where a sphere of radius r [m] about p [m] touches or comes within `reach`
  /// [m], into scratch.touches. A closed mesh has an inside: a centre there is
  /// pushed out through the nearest face, however deep it is; of a mesh that is
  /// inside out, whose inside has no end, up to 2 r. An open mesh is touched from
  /// both sides.
  void touch(const Vec3& p, double r, double reach, MeshScratch& scratch) const;

  /// True when every edge has two triangles of opposite sense.
  [[nodiscard]] bool closed() const { return closed_; }

 private:
  struct Entry {
    Vec3 a, b, c;                         // [m]
    Vec3 normal;                          // unit
    std::array<std::uint32_t, 3> corner;  // welded vertices
    std::uint32_t triangle;               // as given
  };
  struct Node {
    Aabb box;
    std::uint32_t skip;   // node after this subtree
    std::uint32_t first;  // entries of a leaf
    std::uint32_t count;  // 0 for an inner node
  };

  void weld(std::span<const Vec3> vertices, std::span<const Triangle> triangles);
  void find_closed();
  void find_bounded();
  void build(std::uint32_t first, std::uint32_t last);
  void collect(const Vec3& p, double radius, std::vector<MeshHit>& hits) const;
  [[nodiscard]] bool encloses(const Vec3& p) const;
  [[nodiscard]] bool shares_feature(const MeshHit& hit, const MeshHit& other) const;
  [[nodiscard]] bool is_local_minimum(const MeshHit& hit, std::span<const MeshHit> hits) const;
  [[nodiscard]] Vec3 outward(const MeshHit& nearest, std::span<const MeshHit> hits) const;
  void report(const Vec3& p, double r, double reach, MeshScratch& scratch) const;

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
  bool closed_ = false;
  bool bounded_ = false;  // closed, and its triangles look outwards
};

}  // namespace scree::sphere_cluster
