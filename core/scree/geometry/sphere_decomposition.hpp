// Solids as clusters of at most so many balls: what the narrow phase gets for boxes, cylinders and hulls.
//
// Reached with 32 balls, volume within 0.2 % throughout (Hausdorff distance / size; / diameter of the equal sphere):
//   cube 6 %, 9 %; boxes 1:1:2 5 %, 8 %; 1:2:3 5 %, 8 %; 1:4:4 4.5 %, 8 %; 1:10:10 4 %, 9 %
//   cylinders of length / diameter 0.5: 6 %, 8 %; 1: 5.5 %, 7 %; 2: 4 %, 6 %; 10: 2 %, 8 %
//   hulls of 12 to 20 random points: 3.5 to 6.6 %, 5 to 13 %
// Beyond 10 % of the diameter of the equal sphere, though within 10 % of the size, stay what is very thin: plates from
// 1:20:20 (14 %) and 1:40:40 (23 %), discs of length / diameter 0.02 (21 %), needles 1:1:50 (12 %), flakes.
#pragma once

#include <vector>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/solid.hpp"
#include "scree/geometry/sphere.hpp"

namespace scree {

/// What a decomposition may use.
struct SphereDecompositionOptions {
  int max_spheres = 32;  ///< 1 to 1000
  /// 0: use all balls. Else the first of 1, 2, 4, 8, ... max_spheres balls whose hausdorff_of_equivalent is at most this
  /// [1]: fewer balls, cheaper contacts.
  double enough_hausdorff = 0.0;
};

/// A cluster of balls and how far it is from the solid. The size of a solid is the largest distance between two of its
/// points, which is the diameter of the bounding sphere of boxes and cylinders.
struct SphereDecomposition {
  std::vector<Sphere> spheres;           ///< [m], in the frame of the solid; they may stick out of it
  double volume_error = 0.0;             ///< volume of the union / volume of the solid - 1 [1]
  double hausdorff = 0.0;                ///< two-sided Hausdorff distance of the surfaces / size [1]
  double hausdorff_of_equivalent = 0.0;  ///< the same distance / diameter of the sphere of equal volume [1]
};

/// Decomposes a box about the origin. @param half_lengths [m]
/// Deterministic; equal for similar solids up to the scale, so that one decomposition an aspect ratio is kept and scaled
/// (decomposition_cache.hpp). The errors are measured (see solid_deviation.hpp), not promised: the caller decides what is
/// too much.
/// @throws Error (usage) for lengths that are not positive and finite, or a count of balls out of range.
[[nodiscard]] SphereDecomposition decompose_box(const Vec3& half_lengths,
                                                const SphereDecompositionOptions& options = {});
/// The same for a cylinder along z about the origin. @param radius [m] @param half_length [m]
[[nodiscard]] SphereDecomposition decompose_cylinder(double radius, double half_length,
                                                     const SphereDecompositionOptions& options = {});
/// The same for a convex hull.
[[nodiscard]] SphereDecomposition decompose_hull(const ConvexHull& hull,
                                                 const SphereDecompositionOptions& options = {});
/// The same for a closed mesh, convex or not; cost grows with the logarithm of its triangles.
[[nodiscard]] SphereDecomposition decompose_mesh(const TriangleMesh& mesh,
                                                 const SphereDecompositionOptions& options = {});

/// The decomposition of the solid scaled about the frame's origin by `factor` > 0; the errors stay.
[[nodiscard]] SphereDecomposition scaled(SphereDecomposition decomposition, double factor);

}  // namespace scree
