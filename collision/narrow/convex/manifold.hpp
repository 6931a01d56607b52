// The contact points of two convex solids whose normal is known.
#pragma once

#include <cstdint>
#include <vector>

#include "separate.hpp"

namespace scree::convex {

/// One point, in the pair's frame.
struct ManifoldPoint {
  std::uint32_t feature = 0;  ///< below 2^16; 0 for the deepest point of solids that meet in no face or edge
  Vec3 point;                 ///< midway between the surfaces [size of the pair]
  double gap = 0.0;           ///< along the normal [size of the pair]
};

/// Replaces `out` by up to eight points with a gap below `reach` [size of the pair], in increasing order of feature. The
/// features of both surfaces are seen along the normal and one is clipped by the other (Sutherland and Hodgman 1974); the
/// corners of what is left are the points. The deepest has the gap of `found`.
void find_manifold(const ConvexSolid& a, const ConvexSolid& b, const Separation& found, double reach,
                   std::vector<ManifoldPoint>& out);

}  // namespace scree::convex
