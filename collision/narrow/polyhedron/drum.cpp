#include "drum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scree::polyhedron {
namespace {

/// How far a point is from a wall [m], negative beyond it, and the wall's normal into the drum.
struct Wall {
  double distance;
  Vec3 normal;
};

/// Mantle, lid at +z, lid at -z.
std::array<Wall, 3> walls(double r, double h, const Vec3& p) {
  const double rho = std::hypot(p.x, p.y);
  const Vec3 inwards = rho > 0.0 ? Vec3{-p.x / rho, -p.y / rho, 0.0} : Vec3{-1, 0, 0};
  return {Wall{r - rho, inwards}, Wall{h - p.z, {0, 0, -1}}, Wall{h + p.z, {0, 0, 1}}};
}

}  // namespace

void drum_contacts(double r, double h, const Polytope& solid, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out) {
  const double size = solid.size + solid.radius;
  double nearest = size;
  for (const Wall& wall : walls(r, h, transform(in_drum, solid.centre))) {
    if (wall.distance < -size) return;
    nearest = std::min(nearest, wall.distance);
  }
  if (nearest >= size + reach) return;
  for (std::size_t w = 0; w < 3; ++w) {
    for (std::uint32_t i = 0; i < solid.corner_count; ++i) {
      const Vec3 p = transform(in_drum, solid.corner(i));
      const Wall wall = walls(r, h, p)[w];
      const double gap = wall.distance - solid.radius;
      if (!(gap < reach)) continue;
      out.push_back(
          {p - (solid.radius + 0.5 * gap) * wall.normal, wall.normal, gap, std::uint64_t{w} << 16 | i, false});
    }
  }
}

}  // namespace scree::polyhedron
