// Closed forms of the nearest point of simple solids to a point, in the frame of
// the solid (axes of revolution along z).
//
// Signed distance: positive outside, negative inside, where the nearest face
// counts. The normal points out of the solid, towards free space.
#pragma once

#include <array>
#include <cstddef>

#include "scree/math/vec3.hpp"

namespace scree::sphere_cluster {

/// Where a point is, relative to the surface of a solid.
struct Nearest {
  double distance = 0.0;  ///< signed [m]
  Vec3 normal{0, 0, 1};   ///< out of the solid, unit [1], solid's frame
};

/// Box of half edges `half` [m].
[[nodiscard]] Nearest nearest_on_box(const Vec3& half, const Vec3& p);
/// Solid cylinder of radius r [m] and half length h [m].
[[nodiscard]] Nearest nearest_on_cylinder(double r, double h, const Vec3& p);
/// Capsule of radius r [m] about a segment of half length h [m].
[[nodiscard]] Nearest nearest_on_capsule(double r, double h, const Vec3& p);
/// Cone of base radius r [m] at z = -h and apex at z = h [m].
[[nodiscard]] Nearest nearest_on_cone(double r, double h, const Vec3& p);

/// Ellipsoid of half axes `half` [m]: the root of Eberly, "Distance from a point to an ellipse, an ellipsoid, or a
/// hyperellipsoid" (2013), eq. 27, by Newton's method, which is monotone there.
[[nodiscard]] Nearest nearest_on_ellipsoid(const Vec3& half, const Vec3& p);

/// The walls of a closed drum of radius r [m] and half length h [m] seen from
/// inside: mantle, lid at +z, lid at -z. Distances are positive inside.
[[nodiscard]] std::array<Nearest, 3> walls_of_drum(double r, double h, const Vec3& p);

}  // namespace scree::sphere_cluster
