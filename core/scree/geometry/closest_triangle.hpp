// The triangle of a mesh that lies nearest to a point.
#pragma once

#include <cstddef>
#include <limits>

#include "scree/geometry/signed_distance.hpp"
#include "scree/geometry/triangle_tree.hpp"

namespace scree {

/// What closest_triangle() found.
struct NearTriangle {
  std::size_t triangle = 0;
  TrianglePoint at;
  double squared_distance = std::numeric_limits<double>::infinity();  ///< [m2]
};

/// Through the tree of the mesh, O(log n). Of triangles at equal distance the one that the tree holds first.
/// @param p [m], frame of the mesh, which may be open
[[nodiscard]] NearTriangle closest_triangle(const TriangleMesh& mesh, const TriangleTree& tree, const Vec3& p);

}  // namespace scree
