// Contacts of a convex solid with a triangle mesh.
//
// Each triangle near the solid is met as a polytope of its own. What keeps a triangulated plane a plane: the direction of a contact must
// lie in the normal cone of the edge or corner that it names, else it is the triangle's own normal, over the triangle only; points
// that neighbours report alike are one; and of all points in one plane those remain that hold up the solid.
#pragma once

#include <vector>

#include "manifold.hpp"
#include "mesh_surface.hpp"

namespace scree::polyhedron {

/// One contact point on a mesh or a wall.
struct MeshPoint {
  Vec3 at;                    ///< midway between the surfaces [m], frame of the mesh
  Vec3 normal;                ///< unit, from the mesh to the solid [1]
  double gap = 0.0;           ///< [m]
  std::uint64_t feature = 0;  ///< triangle << 32 | part
  bool of_face = false;
  double separation = 0.0;  ///< of the swept solid along the normal, over the whole of it [m]
};

/// A triangle that the solid cuts, and the way out of it.
struct Cut {
  std::uint32_t triangle = 0;  ///< in the tree's order
  bool of_face = false;        ///< along the triangle's own normal
  bool turned = false;         ///< on the back of an open mesh
  Meeting way;
};

/// Buffers of mesh_contacts(), kept by the caller.
struct MeshScratch {
  std::vector<Cut> cuts;
  std::vector<std::uint32_t> near;
  Manifold manifold;
  std::vector<MeshPoint> points, found;
  std::vector<ManifoldPoint> plane;
};

/// Leaves in scratch.points the contacts of a solid that have a gap below `reach` [m], in order of feature. A closed mesh keeps the
/// solid on its outside; an open one on the side of each triangle where the solid's middle is.
void mesh_contacts(const MeshSurface& mesh, const Pose& mesh_pose, const Polytope& solid, const Pose& pose,
                   double reach, MeshScratch& scratch);

}  // namespace scree::polyhedron
