// SurfaceFeature: the face, edge or point with which a convex solid meets another one.
#pragma once

#include <array>

#include "convex_solid.hpp"

namespace scree::convex {

/// Corners of a flat piece of a solid's surface: one, two (an edge or a line of a mantle), or a polygon.
struct SurfaceFeature {
  static constexpr std::size_t kMaxCorners = 48;
  std::array<Vec3, kMaxCorners> corner;  ///< pair's frame [size of the pair]
  std::size_t count = 0;

  void add(const Vec3& point) {
    if (count < kMaxCorners) corner[count++] = point;
  }
};

/// The feature of the surface that faces `d`, a unit vector in the pair's frame: it holds the point farthest along d.
/// Discs are twelve-sided, with a corner in that point.
[[nodiscard]] SurfaceFeature surface_feature(const ConvexSolid& solid, const Vec3& d);

/// Vertices of each face of a hull, in order around it.
[[nodiscard]] FaceLoops face_loops(const ShapeSet& shapes, const Primitive& hull);

}  // namespace scree::convex
