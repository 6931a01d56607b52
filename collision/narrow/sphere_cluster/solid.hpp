// Solid: what the narrow phase keeps of a primitive, small enough to be read
// once per pair.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh_tree.hpp"
#include "scree/collision/collider.hpp"

namespace scree::sphere_cluster {

/// A primitive, reduced. Ranges point into the SolidSet's own buffers.
struct alignas(64) Solid {
  ShapeKind kind = ShapeKind::sphere;
  bool hollow = false;
  std::uint32_t first_sphere = 0, sphere_count = 0;  ///< of a sphere (one) or a cluster
  std::uint32_t primitive = 0;                       ///< index into ShapeSet::primitives()
  std::uint32_t mesh = 0;                            ///< index into meshes, of a triangle mesh
  Vec3 size;                                         ///< as Primitive::size [m]
  double bounding_radius = 0.0;                      ///< [m]
};

/// True for what is made of spheres.
[[nodiscard]] constexpr bool is_round(ShapeKind kind) {
  return kind == ShapeKind::sphere || kind == ShapeKind::sphere_cluster;
}

/// All primitives that were bound.
struct SolidSet {
  const ShapeSet* shapes = nullptr;
  std::vector<Solid> solids;    ///< by primitive
  std::vector<Sphere> spheres;  ///< single spheres and those of clusters
  std::vector<MeshTree> meshes;

  [[nodiscard]] std::span<const Sphere> spheres_of(const Solid& s) const {
    return std::span{spheres}.subspan(s.first_sphere, s.sphere_count);
  }
  /// Adds the primitives from `first_new` on.
  void add(const ShapeSet& from, std::size_t first_new);
};

}  // namespace scree::sphere_cluster
