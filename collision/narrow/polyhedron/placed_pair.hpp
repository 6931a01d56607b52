// PlacedPair: two polytopes, the second one placed in the frame of the first.
#pragma once

#include <algorithm>

#include "polytope.hpp"

namespace scree::polyhedron {

/// Everything about a pair is computed in the frame of `a`, where numbers are as small as the solids.
struct PlacedPair {
  const Polytope& a;
  const Polytope& b;
  Mat3 turn;       ///< of b's axes into a's
  Mat3 turn_back;  ///< of a's axes into b's
  Vec3 shift;      ///< origin of b in a [m]
  double size;     ///< of the smaller solid with its sweep [m]: tolerances are relative to it

  PlacedPair(const Polytope& one, const Pose& pose_a, const Polytope& two, const Pose& pose_b)
      : a{one},
        b{two},
        turn{to_matrix(conjugate(pose_a.orientation) * pose_b.orientation)},
        turn_back{transpose(turn)},
        shift{rotate_back(pose_a.orientation, pose_b.position - pose_a.position)},
        size{std::min(one.size + one.radius, two.size + two.radius)} {}

  [[nodiscard]] Vec3 from_b(const Vec3& p) const { return shift + turn * p; }
  [[nodiscard]] Vec3 to_b(const Vec3& p) const { return turn_back * (p - shift); }
  /// Corner i of b in the frame of a.
  [[nodiscard]] Vec3 corner_b(std::uint32_t i) const { return from_b(b.corner(i)); }
  [[nodiscard]] Vec3 centre_a() const { return a.centre; }
  [[nodiscard]] Vec3 centre_b() const { return from_b(b.centre); }
  [[nodiscard]] double radii() const { return a.radius + b.radius; }

  /// Corner of b that lies deepest against n, a direction from a to b.
  [[nodiscard]] std::uint32_t lowest_of_b(const Vec3& n) const { return farthest(b, -(turn_back * n)); }
  /// Separation of the two along the unit vector n from a to b [m]: at most their distance, negative where they overlap.
  [[nodiscard]] double separation(const Vec3& n) const {
    return dot(n, corner_b(lowest_of_b(n)) - a.corner(farthest(a, n)));
  }
};

}  // namespace scree::polyhedron
