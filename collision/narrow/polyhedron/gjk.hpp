// The distance of two polytopes by the algorithm of Gilbert, Johnson and Keerthi (1988), with the exits of van den Bergen
// ("Collision detection in interactive 3D environments", 2004, section 4.3).
//
// It walks over the difference C = B - A towards the point v of C that is nearest to the origin. With w the corner of C that
// lies deepest against v, v.w / |v| never exceeds the distance: pairs out of reach leave after one or two corners.
#pragma once

#include <array>
#include <cstdint>

#include "placed_pair.hpp"

namespace scree::polyhedron {

/// What the walk ended with.
enum class Approach : std::uint8_t {
  beyond,   ///< the distance is at least the limit; nothing else is known
  apart,    ///< the distance and its two ends are known
  touching  ///< the polytopes share a point, to 1e-8 of the smaller one
};

/// Two polytopes, without their sweeps, in the frame of the first.
struct Distance {
  Approach approach = Approach::beyond;
  Vec3 on_a;                ///< nearest point of a, or the shared point [m]
  Vec3 on_b;                ///< nearest point of b, or the shared point [m]
  double length = 0.0;      ///< distance [m]
  Vec3 normal;              ///< unit, from a to b, when apart [1]
  std::uint32_t count = 0;  ///< corners that carry the nearest points
  std::array<std::uint32_t, 4> corner_a{}, corner_b{};
};

/// The distance where it is below `limit` [m].
[[nodiscard]] Distance distance(const PlacedPair& pair, double limit);

}  // namespace scree::polyhedron
