// ParticleTemplate: a shape of unit size that particles of one family are scaled from.
//
// Size is the diameter of the sphere of equal volume. Collision sees a cluster of at most 32 spheres; mass and inertia are
// those of the true solid, in whose principal frame the spheres are given.
#pragma once

#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/sphere.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// Largest errors of a cluster that a feed accepts.
inline constexpr double kVolumeLimit = 0.05;     ///< of the volume [1]
inline constexpr double kHausdorffLimit = 0.10;  ///< Hausdorff distance over the size of the solid [1]

/// A particle of size 1 m.
struct ParticleTemplate {
  std::vector<Sphere> spheres;   ///< in the principal frame of the true solid [m]
  Vec3 unit_inertia;             ///< principal moments of the true solid for a density of 1 [m5]
  double bounding_radius = 0.5;  ///< of the spheres about the centre of mass [m]
  double volume_error = 0.0;     ///< of the cluster, relative [1]
  double hausdorff = 0.0;        ///< of the cluster, over the size of the solid [1]
};

/// The alternatives of a family's `shape`.
[[nodiscard]] std::vector<Variant> particle_shapes();

/// The templates of a family: one, or several for random hulls.
/// @throws Error (usage) when the shape cannot be made or a cluster of 32 spheres does not come within the limits.
[[nodiscard]] std::vector<ParticleTemplate> make_templates(const Options& shape, const std::string& family);

/// The shape of a particle of `size` [m].
[[nodiscard]] ShapeData scaled_shape(const ParticleTemplate& unit, double size);

}  // namespace scree
