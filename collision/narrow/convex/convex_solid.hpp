// ConvexSolid: one convex solid of a pair, as GJK and EPA see it: a pose and a support function.
//
// Lengths are divided by the size of the smaller solid of the pair, so that tolerances are the same for dust and for
// boulders; the origin lies in that solid.
#pragma once

#include <span>
#include <vector>

#include "scree/model/shape_set.hpp"

namespace scree::convex {

/// Vertices of each face of a hull, counter-clockwise seen from outside.
using FaceLoops = std::vector<std::vector<std::uint32_t>>;

/// A core and the ball of radius `round` that rolls about it. A sphere's core is a point, a capsule's a segment.
struct ConvexSolid {
  ShapeKind kind = ShapeKind::sphere;  ///< no mesh, cluster or plane; a triangle is a convex_hull of three vertices
  Vec3 size;                           ///< as Primitive::size [size of the pair]
  double round = 0.0;                  ///< [size of the pair]
  double bound = 0.0;                  ///< all of it is this near to the pose's position [size of the pair]
  Pose pose;                           ///< own frame to the pair's [size of the pair]
  double scale = 1.0;                  ///< of the vertices [1/m]
  std::span<const Vec3> vertices;      ///< of a hull, own frame [m]
  const FaceLoops* loops = nullptr;    ///< of a hull; none for a triangle, which is its own face
};

/// The point of the core farthest along `d` (of any length), in the solid's own frame.
[[nodiscard]] Vec3 local_core_support(const ConvexSolid& solid, const Vec3& d);

/// The same in the pair's frame.
[[nodiscard]] inline Vec3 core_support(const ConvexSolid& solid, const Vec3& d) {
  return transform(solid.pose, local_core_support(solid, rotate_back(solid.pose.orientation, d)));
}

/// How far the cores are apart along the unit vector n, from a to b; less than zero where they overlap. For no direction
/// is it more than their distance.
[[nodiscard]] inline double core_separation(const ConvexSolid& a, const ConvexSolid& b, const Vec3& n) {
  return dot(n, core_support(b, -n) - core_support(a, n));
}

/// The same of the solids.
[[nodiscard]] inline double separation(const ConvexSolid& a, const ConvexSolid& b, const Vec3& n) {
  return core_separation(a, b, n) - a.round - b.round;
}

}  // namespace scree::convex
