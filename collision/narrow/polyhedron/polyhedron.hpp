// Narrow phase `polyhedron`: several points between boxes, hulls, capsules and triangle meshes.
//
// The distance by Gilbert, Johnson and Keerthi; the depth by separating axes; the points by clipping faces. Nothing is kept
// between steps.
#pragma once

#include "mesh_contacts.hpp"
#include "mesh_surface.hpp"
#include "polytope.hpp"
#include "scree/interfaces/narrow_phase.hpp"

namespace scree {

/// Contacts of boxes, convex hulls and capsules with each other and with triangle meshes, and of all but planes and what is
/// made of spheres inside hollow cylinders. Features name corners and pairs of edges, on meshes within a triangle.
class Polyhedron : public NarrowPhase {
 public:
  [[nodiscard]] bool supports(ShapeKind a, ShapeKind b) const override;
  [[nodiscard]] bool supports_hollow(ShapeKind inside) const override;
  void bind(const ShapeSet& shapes, std::size_t first_new_primitive) override;
  void collide(const ColliderView& colliders, std::span<const ColliderPair> pairs, ContactBuffer& out) const override;

 private:
  void collide_drum(std::uint32_t drum, const Pose& drum_pose, std::uint32_t inside, const Pose& pose, double reach,
                    std::vector<polyhedron::MeshPoint>& out) const;

  const ShapeSet* shapes_ = nullptr;
  polyhedron::PolytopeSet polytopes_;
  std::vector<polyhedron::MeshSurface> meshes_;
  std::vector<std::uint32_t> mesh_of_;  // by primitive
};

}  // namespace scree
