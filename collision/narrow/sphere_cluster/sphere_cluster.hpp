// Narrow phase `sphere_cluster`: closed forms of spheres and rigid clusters of
// spheres against everything, and of corners against planes.
//
// One sphere and one convex solid give one contact: along the line from the
// sphere's centre to the nearest point of the solid, or, when the centre is
// inside, through the nearest face. A drum gives one contact a wall, a mesh one
// a local minimum of the distance.
#pragma once

#include "scree/interfaces/narrow_phase.hpp"
#include "solid.hpp"

namespace scree {

/// Closed-form contacts. Features: 0 for single spheres; sphere << 48 for the
/// sphere of a cluster, in the low bits wall of a drum or part of a mesh;
/// (sphere of a) << 24 | sphere of b between clusters; the point against a plane.
class SphereCluster : public NarrowPhase {
 public:
  [[nodiscard]] bool supports(ShapeKind a, ShapeKind b) const override;
  [[nodiscard]] bool supports_hollow(ShapeKind inside) const override;
  [[nodiscard]] bool reads_sphere_poses() const override { return false; }
  void bind(const ShapeSet& shapes, std::size_t first_new_primitive) override;
  void collide(const ColliderView& colliders, std::span<const ColliderPair> pairs, ContactBuffer& out) const override;

 private:
  sphere_cluster::SolidSet set_;
};

}  // namespace scree
