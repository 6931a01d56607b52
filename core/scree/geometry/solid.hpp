// Solid: a body given by its signed distance and its surface, as decomposition and its measure need it.
#pragma once

#include <functional>
#include <vector>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// A solid in a frame of its own.
struct Solid {
  std::function<double(const Vec3&)> signed_distance;  ///< [m], negative inside, exact, safe from several threads
  TriangleMesh surface;  ///< of it, or inscribed in it [m]: where samples of the surface start from
  double volume = 0.0;   ///< [m^3], exact
  double size = 0.0;  ///< largest distance between two of its points [m]: the diameter of the bounding sphere of boxes
                      ///< and cylinders
};

/// A box about the origin. @param half_lengths [m]
[[nodiscard]] Solid box_solid(const Vec3& half_lengths);
/// A solid cylinder along z about the origin. @param radius [m] @param half_length [m]
[[nodiscard]] Solid cylinder_solid(double radius, double half_length);
/// A convex hull, in the frame of its corners.
[[nodiscard]] Solid hull_solid(const ConvexHull& hull);
/// The inside of a closed mesh. @throws Error (usage) when the mesh is not a solid.
[[nodiscard]] Solid mesh_solid(const TriangleMesh& mesh);

/// A point of a surface with a normal that points outwards there.
struct SurfaceSample {
  Vec3 point;   ///< [m]
  Vec3 normal;  ///< unit [1]; at corners and edges the mean of the faces that meet
};

/// About `count` points spread evenly over the faces, and every corner and the edges besides. Deterministic.
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const Solid& solid, int count);

}  // namespace scree
