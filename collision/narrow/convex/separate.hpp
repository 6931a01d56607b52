// What is done with the answer of a collision library: it is checked, made exact, and replaced where it fails.
#pragma once

#include <optional>

#include "convex_solid.hpp"

namespace scree::convex {

/// How two solids lie to each other.
struct Separation {
  Vec3 normal;       ///< unit, from a to b
  double gap = 0.0;  ///< along the normal: exactly that of its two supporting planes [size of the pair]
  Vec3 on_a, on_b;   ///< on the two surfaces, `gap` apart along the normal [size of the pair]
};

/// What a library says of the cores of two solids, or, where the cores meet, of the solids.
struct Answer {
  Vec3 normal;            ///< from a to b, of any length
  double distance = 0.0;  ///< less than zero: depth [size of the pair]
  Vec3 on_a, on_b;        ///< the points that are so far apart [size of the pair]
  bool of_cores = true;
};

/// Climbs from `start`, a unit vector, to a direction along which the solids are farthest apart (or overlap least): b is
/// moved out along the present direction, and the nearest points then give the next one, along which they are no less
/// apart. Where the cores do not meet, the first step finds the distance. Nothing when rounding spoils it.
[[nodiscard]] std::optional<Separation> climb(const ConvexSolid& a, const ConvexSolid& b, const Vec3& start);

/// The answer made exact, or nothing when it does not hold. No direction shows a gap larger than the true one, and a
/// library's own gap is no smaller than that: where its normal shows the gap that it claims, to 1e-7, both are exact.
/// Else the normal climbs; where that ends more than 1e-3 of the smaller solid from what was claimed, or anything is no
/// number, the answer is refused; and so is a depth when one of some hundred likely directions shows less of it.
[[nodiscard]] std::optional<Separation> checked(const ConvexSolid& a, const ConvexSolid& b, const Answer& answer);

/// The fallback: the best of the climbs from the 24 most promising of those directions. Always finite.
[[nodiscard]] Separation best_climb(const ConvexSolid& a, const ConvexSolid& b);

}  // namespace scree::convex
