// ConvexPhase: a narrow phase around a library that measures two convex solids.
//
// A cluster is its spheres, a mesh its triangles. The library gives the normal and the distance or depth of two of them;
// here lengths are scaled for it, its answer is checked and made exact, or replaced, and contact points are found.
#pragma once

#include <atomic>
#include <memory>

#include "scree/geometry/signed_distance.hpp"
#include "scree/interfaces/narrow_phase.hpp"
#include "separate.hpp"
#include "surface_feature.hpp"
#include "surface_tree.hpp"

namespace scree::convex {

/// Distances from the surface of a mesh, negative inside; nothing where it does not bound a solid.
[[nodiscard]] std::unique_ptr<MeshDistance> make_inside(const ShapeSet& shapes, const Primitive& mesh);

/// Everything but the library. Features: (part of a * parts of b + part of b) << 16 | place in the manifold, where a
/// cluster's parts are its spheres and a mesh's its triangles.
class ConvexPhase : public NarrowPhase {
 public:
  /// All kinds but two planes. Hollow cylinders are refused when a pair with one comes.
  [[nodiscard]] bool supports(ShapeKind a, ShapeKind b) const override;
  void bind(const ShapeSet& shapes, std::size_t first_new_primitive) override;
  /// @throws Error (usage) for a hollow cylinder.
  void collide(const ColliderView& colliders, std::span<const ColliderPair> pairs, ContactBuffer& out) const override;
  [[nodiscard]] std::uint64_t fallbacks() const override { return fallbacks_; }

 protected:
  /// What the library says of two solids, within 1e5 of each other's size; anything at all where it fails.
  [[nodiscard]] virtual Answer ask(const ConvexSolid& a, const ConvexSolid& b) const = 0;

 private:
  struct Pair;
  void collide_pair(Pair& pair) const;
  void collide_parts(Pair& pair, std::uint32_t part_a, std::uint32_t part_b) const;
  void add_manifold(Pair& pair, std::uint32_t part_a, std::uint32_t part_b, const ConvexSolid& a, const ConvexSolid& b,
                    const Separation& found) const;
  void add_orphans(Pair& pair) const;
  /// The hull of some triangles of a mesh and of those across their convex edges, kept in `corners`; all of what is no mesh.
  [[nodiscard]] ConvexSolid patch(const Pair& pair, std::uint32_t primitive, const Pose& pose,
                                  std::vector<std::uint32_t> parts, std::vector<Vec3>& corners) const;
  /// Of a triangle: 1 when the other solid is in front of it or the mesh is closed, else -1; 0 of all that is no mesh.
  [[nodiscard]] double side_of(std::uint32_t primitive, const Pose& pose, std::uint32_t part, const Vec3& other) const;
  void collide_plane(Pair& pair, std::uint32_t part) const;
  /// What of one part of a solid is nearest to the half space below `foot` [m], whose outward normal is `up`: world.
  /// `plane_first`: the half space is that of body a.
  void touch_plane(Pair& pair, std::uint32_t part, bool plane_first, const Vec3& foot, const Vec3& up,
                   std::uint64_t parts) const;
  /// Where the middle of a solid lies inside of a closed mesh, its contacts with the facet nearest to that, along whose
  /// normal it is led out; false elsewhere. @param mesh_first the mesh is body a
  bool lead_out(Pair& pair, bool mesh_first) const;
  /// The same of one part, whose middle is `middle` in the solid's frame [m]; where another one `is_inside`, that stays true.
  bool lead_part_out(Pair& pair, bool mesh_first, std::uint32_t part, const Vec3& middle, bool is_inside) const;
  [[nodiscard]] Vec3 middle_of(std::uint32_t primitive) const;
  [[nodiscard]] std::optional<Separation> separate(Pair& pair, const ConvexSolid& a, const ConvexSolid& b) const;
  void find_parts(const Pair& pair, std::uint32_t primitive, const Pose& pose, std::uint32_t other,
                  const Pose& other_pose, std::vector<std::uint32_t>& out) const;
  [[nodiscard]] ConvexSolid solid(const Pair& pair, std::uint32_t primitive, const Pose& pose,
                                  std::uint32_t part) const;
  [[nodiscard]] std::size_t part_count(std::uint32_t primitive) const;

  const ShapeSet* shapes_ = nullptr;
  std::vector<FaceLoops> loops_;                       // by primitive
  std::vector<std::unique_ptr<SurfaceTree>> meshes_;   // by primitive
  std::vector<std::unique_ptr<MeshDistance>> inside_;  // by primitive; of meshes that bound a solid
  mutable std::atomic<std::uint64_t> fallbacks_ = 0;
};

}  // namespace scree::convex
