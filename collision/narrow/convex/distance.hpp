// The distance of two convex cores that do not meet (Gilbert, Johnson and Keerthi 1988).
#pragma once

#include "convex_solid.hpp"

namespace scree::convex {

/// Nearest points of two cores.
struct Closest {
  bool apart = false;     ///< false: they meet, and nothing else is known
  double distance = 0.0;  ///< [size of the pair]
  Vec3 direction;         ///< from a to b, unit
  Vec3 on_a, on_b;        ///< [size of the pair]
};

/// Of `a` and of `b` moved by `shift`. On the difference of the two, a simplex walks to the point nearest to the origin;
/// that of a simplex is the best among the projections onto all its faces, however flat they are.
[[nodiscard]] Closest distance(const ConvexSolid& a, const ConvexSolid& b, const Vec3& shift);

}  // namespace scree::convex
