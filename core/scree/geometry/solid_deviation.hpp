// How far a cluster of balls is from the solid that it stands for.
#pragma once

#include <span>

#include "scree/geometry/solid.hpp"
#include "scree/geometry/sphere.hpp"

namespace scree {

/// Differences between a solid and a union of balls.
struct SolidDeviation {
  double volume_error = 0.0;      ///< volume of the union / volume of the solid - 1 [1]
  double solid_to_cluster = 0.0;  ///< largest distance of a point of the solid's surface to the union's surface [m]
  double cluster_to_solid = 0.0;  ///< largest distance of a point of the union's surface to the solid's surface [m]

  /// Hausdorff distance of the two surfaces [m].
  [[nodiscard]] double hausdorff() const {
    return solid_to_cluster > cluster_to_solid ? solid_to_cluster : cluster_to_solid;
  }
};

/// The Hausdorff part only; volume_error is zero.
[[nodiscard]] SolidDeviation measure_distances(const Solid& solid, std::span<const Sphere> spheres, int samples);

/// Measures both, by samples.
///
/// The surface of the solid is sampled at about `samples` points plus corners and edges, that of the union at as many
/// plus points on the circles where balls meet, because the deepest crevices are there. Distances of points outside the
/// union, and of points of the union to the solid, are exact; a point of the solid inside the union gets the way out
/// along the normal, an upper bound. Sampling: with 3000 samples, refining them eight times changes the Hausdorff
/// distance of 32 balls by less than 1 % of the size.
[[nodiscard]] SolidDeviation measure_deviation(const Solid& solid, std::span<const Sphere> spheres, int samples = 3000);

}  // namespace scree
