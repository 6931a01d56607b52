// Solids inside a hollow cylinder, a drum seen from inside.
//
// The free space of a drum is convex, so that a solid is inside when its outermost points are, and these are known in closed
// form: corners; of the round rim of a cylinder or cone, and of an ellipsoid, the points farthest from the drum's axis.
#pragma once

#include <vector>

#include "mesh_contacts.hpp"

namespace scree::polyhedron {

/// A hollow cylinder about z of its own frame.
struct Drum {
  double radius = 0.0;       ///< [m]
  double half_length = 0.0;  ///< [m]
};

/// Appends the contacts of a solid at `in_drum`, its pose in the drum's frame, that have a gap below `reach` [m], in order of
/// feature, wall << 32 | corner. A solid whose middle is more than its size beyond a wall has left and touches nothing.
void drum_contacts(const Drum& drum, const Polytope& solid, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out);

/// The same for the corners of a mesh.
void drum_contacts(const Drum& drum, const MeshSurface& mesh, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out);

/// The same for a cylinder, cone or ellipsoid; `size` as Primitive::size [m]. Of a rim the farthest point, the other one that
/// is farther than all about it, where there is one, and two at 120 degrees from the first, so that what fits closely or
/// stands on a lid is held from all sides.
void drum_contacts(const Drum& drum, ShapeKind kind, const Vec3& size, const Pose& in_drum, double reach,
                   std::vector<MeshPoint>& out);

}  // namespace scree::polyhedron
