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
struct Solid {
  ShapeKind kind = ShapeKind::sphere;
  bool hollow = false;
  std::uint32_t first = 0;         ///< its first sphere, of a cluster; its place among the meshes, of a triangle mesh
  std::uint32_t sphere_count = 0;  ///< of a cluster; a single sphere has all in `size`
  std::uint32_t primitive = 0;     ///< index into ShapeSet::primitives()
  Vec3 size;                       ///< as Primitive::size [m]
  double bounding_radius = 0.0;    ///< [m]
};

/// True for what is made of spheres.
[[nodiscard]] constexpr bool is_round(ShapeKind kind) {
  return kind == ShapeKind::sphere || kind == ShapeKind::sphere_cluster;
}

/// All primitives that were bound.
struct SolidSet {
  const ShapeSet* shapes = nullptr;
  std::vector<std::uint32_t>
      solid_of;  ///< by primitive: its place in `solids`; a sphere has none, it may be one of millions
  std::vector<Solid> solids;
  std::vector<Sphere> spheres;  ///< of clusters
  std::vector<MeshTree> meshes;

  [[nodiscard]] Solid solid(std::uint32_t primitive) const;
  /// The spheres of a round solid; `single` is room for the only one of a sphere, and has to live as long as the result.
  [[nodiscard]] std::span<const Sphere> spheres_of(const Solid& s, Sphere& single) const {
    if (s.kind != ShapeKind::sphere) return std::span{spheres}.subspan(s.first, s.sphere_count);
    single = {{}, s.size.x};
    return {&single, 1};
  }
  /// Adds the primitives from `first_new` on.
  void add(const ShapeSet& from, std::size_t first_new);
};

}  // namespace scree::sphere_cluster
