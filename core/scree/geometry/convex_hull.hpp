// Convex hulls of points, by Qhull (Barber, Dobkin, Huhdanpaa, "The Quickhull algorithm for convex hulls", 1996).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/geometry/face.hpp"
#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// A convex solid, as corners, planes and triangles.
struct ConvexHull {
  std::vector<Vec3> vertices;                ///< [m], corners in the order of the input points
  std::vector<std::uint32_t> sources;        ///< index of each corner among the input points
  std::vector<Face> faces;                   ///< one a plane: coplanar triangles are merged
  std::vector<Triangle> triangles;           ///< indices into vertices, counter-clockwise seen from outside
  std::vector<std::uint32_t> triangle_face;  ///< the face that each triangle belongs to
};

/// The convex hull of at least four points [m] that do not lie in one plane. Works at any scale; safe from several
/// threads at once. The same set of points gives the same solid in any order.
/// @throws Error (usage) for fewer than four points, coordinates that are not finite, and points on a line or plane
/// (thinner than 1e-9 of their extent).
[[nodiscard]] ConvexHull convex_hull(std::span<const Vec3> points);

/// The surface of a hull as a mesh.
[[nodiscard]] TriangleMesh surface_of(const ConvexHull& hull);

/// The hull scaled about the frame's origin by `factor` > 0.
[[nodiscard]] ConvexHull scaled(ConvexHull hull, double factor);

}  // namespace scree
