// Aabb: boxes aligned with the world's axes.
#pragma once

#include <algorithm>
#include <limits>

#include "scree/math/vec3.hpp"

namespace scree {

/// An axis-aligned box; empty when lower > upper on any axis, unbounded where a side is infinite.
struct Aabb {
  Vec3 lower;  ///< [m], world
  Vec3 upper;  ///< [m], world

  constexpr bool operator==(const Aabb&) const = default;

  static constexpr Aabb empty() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return {{inf, inf, inf}, {-inf, -inf, -inf}};
  }
  static constexpr Aabb everywhere() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return {{-inf, -inf, -inf}, {inf, inf, inf}};
  }
};

constexpr bool overlap(const Aabb& a, const Aabb& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

constexpr bool contains(const Aabb& box, const Vec3& p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
         p.z <= box.upper.z;
}

constexpr Aabb expanded(const Aabb& a, double by) { return {a.lower - Vec3{by, by, by}, a.upper + Vec3{by, by, by}}; }

constexpr Aabb merged(const Aabb& a, const Aabb& b) {
  return {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y), std::min(a.lower.z, b.lower.z)},
          {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y), std::max(a.upper.z, b.upper.z)}};
}

constexpr Aabb merged(const Aabb& a, const Vec3& p) { return merged(a, Aabb{p, p}); }

inline bool is_bounded(const Aabb& a) { return is_finite(a.lower) && is_finite(a.upper); }

}  // namespace scree
