// The direction along which a convex solid is pushed out of a triangle that it cuts: the triangle's normal, or one that the
// mesh admits at an edge or a corner of the triangle and that is clearly shallower.
#pragma once

#include "mesh_surface.hpp"
#include "penetration.hpp"

namespace scree::polyhedron {

/// `pair` is the triangle and the solid; `out` the triangle's normal on the side where the solid is to stay; `p` a point that both share [m],
/// mesh frame.
[[nodiscard]] Axis axis_out_of(const MeshSurface& mesh, const MeshTriangle& triangle, const PlacedPair& pair,
                               const Vec3& out, const Vec3& p);

/// Whether the mesh can be touched along m at the part of the triangle that lies farthest along m: always on its face.
[[nodiscard]] bool admits(const MeshSurface& mesh, const MeshTriangle& triangle, const Vec3& m);

}  // namespace scree::polyhedron
