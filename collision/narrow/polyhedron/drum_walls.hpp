// The walls of a drum: mantle, lid at +z, lid at -z, and what touches them.
#pragma once

#include <algorithm>
#include <cmath>

#include "drum.hpp"

namespace scree::polyhedron {

inline constexpr std::uint32_t kWalls = 3;
inline constexpr std::uint32_t kMantle = 0;

/// How far a point is from a wall [m], negative beyond it, and the wall's normal into the drum.
struct WallPoint {
  double distance = 0.0;
  Vec3 normal;
};

[[nodiscard]] inline WallPoint at_wall(const Drum& drum, std::uint32_t wall, const Vec3& p) {
  if (wall != kMantle) {
    const double up = wall == 1 ? 1.0 : -1.0;
    return {drum.half_length - up * p.z, {0.0, 0.0, -up}};
  }
  const double rho = std::hypot(p.x, p.y);
  return {drum.radius - rho, rho > 0.0 ? Vec3{-p.x / rho, -p.y / rho, 0.0} : Vec3{-1.0, 0.0, 0.0}};
}

/// False for a ball of radius `size` [m] about the middle of a solid that is not within reach of any wall, or has left.
[[nodiscard]] inline bool is_near_wall(const Drum& drum, const Vec3& middle, double size, double reach) {
  double nearest = size + reach;
  for (std::uint32_t wall = 0; wall < kWalls; ++wall) {
    const double distance = at_wall(drum, wall, middle).distance;
    if (distance < -size) return false;
    nearest = std::min(nearest, distance);
  }
  return nearest < size + reach;
}

/// Appends the contact of a point of a solid, or of a ball of radius `round` [m] about it, with a wall.
inline void touch(const Drum& drum, std::uint32_t wall, const Vec3& p, double round, std::uint32_t corner, double reach,
                  std::vector<MeshPoint>& out) {
  const WallPoint at = at_wall(drum, wall, p);
  const double gap = at.distance - round;
  if (!(gap < reach)) return;
  out.push_back({p - (round + 0.5 * gap) * at.normal, at.normal, gap, std::uint64_t{wall} << 32 | corner, false});
}

}  // namespace scree::polyhedron
