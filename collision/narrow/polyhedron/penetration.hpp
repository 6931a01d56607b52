// How deep two polytopes overlap, by separating axes (Gottschalk, Lin, Manocha 1996): normals of faces, and cross products of
// edges whose arcs cross on the Gauss map (Gregorius, "The separating axis test between convex polyhedra", 2013).
//
// A point p that lies in both solids prunes almost everything: with depth d along n, p is at most d below the surface of
// each solid along n. So a face deeper below which p lies than the best depth so far cannot give a better one, and neither
// can an edge both of whose faces are that far away. In shallow contacts two or three faces a solid remain.
#pragma once

#include <vector>

#include "placed_pair.hpp"

namespace scree::polyhedron {

/// The direction of least overlap.
struct Axis {
  Vec3 normal;              ///< unit, from a to b [1], frame of a
  double separation = 0.0;  ///< along it [m]; negative for the depth
  bool of_edges = false;    ///< else of a face
  Vec3 on_a, on_b;          ///< where the edges come nearest, else the shared point [m], frame of a
};

/// An edge that can be part of the best axis, in the frame of a.
struct NearEdge {
  Vec3 from, along;    ///< [m]
  Vec3 left, right;    ///< outward normals of its faces; of b's edges turned round
  double depth = 0.0;  ///< of the shared point below the shallower face [m]
};

/// Buffers of penetration(), kept by the caller.
struct AxisScratch {
  std::vector<double> depth_a, depth_b;  ///< of the shared point below each face [m]
  std::vector<double> deep_a, deep_b;    ///< of the other solid's deepest corner below each face [m]
  std::vector<NearEdge> edges_a, edges_b;
};

/// The axis of greatest separation of two solids that share the point `p` [m], in the frame of a, or touch there. At least one
/// of them has faces.
[[nodiscard]] Axis penetration(const PlacedPair& pair, const Vec3& p, AxisScratch& scratch);

/// Where two lines, through p along u and through q along v, come nearest; their middles when parallel.
[[nodiscard]] std::pair<Vec3, Vec3> nearest_of_lines(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v);

}  // namespace scree::polyhedron
