// Triangulated surfaces of shapes, for pictures.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scree/model/shape_set.hpp"

namespace scree {

/// Triangles in the world.
struct Surface {
  std::vector<Vec3> points;  ///< [m], world
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// How fine a surface becomes.
struct SurfaceOptions {
  int segments = 64;        ///< of a full circle
  double plane_size = 1.0;  ///< edge of the square that stands for a plane [m]
};

/// Appends the surface of a shape at the pose of its body. Round parts are polyhedra with corners on the surface.
void append_surface(const ShapeSet& shapes, const Shape& shape, const Pose& body, const SurfaceOptions& options,
                    Surface& out);

/// The same for one primitive of a shape.
void append_surface(const ShapeSet& shapes, const Primitive& primitive, const Pose& body, const SurfaceOptions& options,
                    Surface& out);

}  // namespace scree
