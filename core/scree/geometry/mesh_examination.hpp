// What only a closer look at a surface tells: crossings with itself, its shells, how they nest, and whether it has two sides.
//
// Glossary
//   shell    triangles that hang together by edges
//   w        winding number of a point: how often the other shells enclose it, outward ones counted up, inward ones down
// A shell bounds matter when w is 0 and its normals point outwards, and a cavity when w is 1 and they point inwards.
#pragma once

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// Corners, edges and faces that pass each other by less than this part of the extent touch [1]: mesh files hold single
/// precision.
inline constexpr double kTouching = 1e-6;
/// Crossings are counted up to here: a mesh with so many is no surface, and counting them all could take for ever.
inline constexpr std::size_t kMostCrossings = 1000;

/// Everything that check_mesh() finds, and the fields that it leaves open: crossings, shells, misplaced shells, sides.
/// Cost O(n log n) for n triangles of about equal size; shells that lie in each other's boxes cost their product.
[[nodiscard]] MeshReport examine_mesh(const TriangleMesh& mesh);

}  // namespace scree
