// The nearest point of a triangle (Ericson 2005, "Real-time collision
// detection", section 5.1.5), with the part of the triangle it lies on.
#pragma once

#include <cstdint>

#include "scree/math/vec3.hpp"

namespace scree::sphere_cluster {

/// Part of a triangle a b c whose Voronoi region holds a point.
enum class TrianglePart : std::uint8_t { face, edge_ab, edge_bc, edge_ca, vertex_a, vertex_b, vertex_c };

/// Nearest point of a triangle.
struct OnTriangle {
  Vec3 point;  ///< [m]
  TrianglePart part = TrianglePart::face;
};

/// The point of triangle a b c nearest to p; all [m], one frame.
[[nodiscard]] OnTriangle nearest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

}  // namespace scree::sphere_cluster
