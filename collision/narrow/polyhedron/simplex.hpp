// Simplex: up to four corners of B - A, and their nearest point to the origin (Ericson 2005, "Real-time collision detection",
// sections 5.1.2 to 5.1.6).
#pragma once

#include <array>
#include <cstdint>

#include "scree/math/vec3.hpp"

namespace scree::polyhedron {

/// A corner of B - A with the corners of A and B that it comes from.
struct SimplexCorner {
  Vec3 w;  ///< b - a [m]
  Vec3 a;  ///< [m]
  std::uint32_t of_a = 0, of_b = 0;
};

/// Reduced after each step to the corners that carry the nearest point.
struct Simplex {
  std::uint32_t count = 0;
  std::array<SimplexCorner, 4> corner;
  std::array<double, 4> weight{};  ///< of each corner in the nearest point; they add up to one

  /// Appends a corner; false when it is there already.
  bool add(const SimplexCorner& c) {
    for (std::uint32_t k = 0; k < count; ++k) {
      if (corner[k].of_a == c.of_a && corner[k].of_b == c.of_b) return false;
    }
    corner[count++] = c;
    return true;
  }
  /// Reduces the simplex and returns its nearest point; zero with all four corners kept when the origin lies inside. `apart`: it
  /// is known not to lie inside.
  Vec3 reduce(bool apart);
};

}  // namespace scree::polyhedron
