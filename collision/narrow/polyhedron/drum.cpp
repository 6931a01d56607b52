#include "drum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "drum_walls.hpp"

namespace scree::polyhedron {

void drum_contacts(const Drum& drum, const Polytope& solid, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out) {
  if (!is_near_wall(drum, transform(in_drum, solid.centre), solid.size + solid.radius, reach)) return;
  for (std::uint32_t wall = 0; wall < kWalls; ++wall) {
    for (std::uint32_t i = 0; i < solid.corner_count; ++i)
      touch(drum, wall, transform(in_drum, solid.corner(i)), solid.radius, i, reach, out);
  }
}

void drum_contacts(const Drum& drum, const MeshSurface& mesh, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out) {
  const auto corners = mesh.corners();
  if (!is_near_wall(drum, transform(in_drum, mesh.middle()), mesh.size(), reach)) return;
  for (std::uint32_t wall = 0; wall < kWalls; ++wall) {
    for (std::uint32_t i = 0; i < corners.size(); ++i)
      touch(drum, wall, transform(in_drum, corners[i]), 0.0, i, reach, out);
  }
}

}  // namespace scree::polyhedron
