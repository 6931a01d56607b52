// A convex solid inside a hollow cylinder, a drum seen from inside.
//
// The free space of a drum is convex: a polytope is inside when its corners are, so each corner near the mantle or a lid is a
// contact, in closed form.
#pragma once

#include <vector>

#include "mesh_contacts.hpp"

namespace scree::polyhedron {

/// Appends the contacts of a solid at `in_drum`, its pose in the drum's frame, with a drum of radius r [m] and half length h [m]
/// about z that have a gap below `reach` [m], in order of feature, wall << 16 | corner. A solid whose middle is more than its
/// size beyond a wall has left and touches nothing.
void drum_contacts(double r, double h, const Polytope& solid, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out);

}  // namespace scree::polyhedron
