// ParticleTemplate: a shape of unit size that particles of one family are scaled from.
//
// Size is the diameter of the sphere of equal volume. Collision sees a cluster of at most `max_spheres` spheres: the first
// of 1, 2, 4, ... that comes well within the limits below. Mass and inertia are those of the true solid, in whose principal
// frame the spheres are given.
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
inline constexpr double kHausdorffLimit = 0.10;  ///< Hausdorff distance over the size of the particle [1]
/// A cluster this close gets no more spheres, since contacts cost in proportion to them [1].
inline constexpr double kEnoughHausdorff = 0.08;

/// What a measured particle brings with it.
struct Measured {
  double size = 0.0;     ///< diameter of the sphere of equal volume [m]; 0: not measured, the family's laws hold
  double density = 0.0;  ///< [kg/m3]
};

/// A particle of size 1 m.
struct ParticleTemplate {
  std::vector<Sphere> spheres;   ///< in the principal frame of the true solid [m]
  Vec3 unit_inertia;             ///< principal moments of the true solid for a density of 1 [m5]
  double bounding_radius = 0.5;  ///< of the spheres about the centre of mass [m]
  double volume_error = 0.0;     ///< of the cluster, relative [1]
  double hausdorff = 0.0;        ///< of the cluster, over the size: the diameter of the sphere of equal volume [1]
                                 ///< (of scanned particles over the largest extent)
  Measured measured = {};
};

/// What became of the rows of a table of scanned particles.
struct ScanRows {
  std::size_t used = 0, refused = 0, of_other_materials = 0;
};

/// The templates of a family: one, or several for random hulls and scanned particles.
struct TemplateSet {
  std::vector<ParticleTemplate> templates;
  int redrawn = 0;  ///< random hulls thrown away because their clusters missed the limits
  ScanRows rows = {};
};

/// Moves spheres into the principal frame of the solid and scales it to the volume of a sphere of diameter 1.
[[nodiscard]] ParticleTemplate normalised(std::vector<Sphere> spheres, const MassProperties& solid);

/// The alternatives of a family's `shape`, but scanned particles (scan_family.hpp).
[[nodiscard]] std::vector<Variant> particle_shapes();

/// Makes the templates of a family. A random hull whose cluster misses the limits is drawn again.
/// @throws Error (usage) when the shape cannot be made or a cluster does not come within the limits.
[[nodiscard]] TemplateSet make_templates(const Options& shape, const std::string& family);

/// The shape of a particle of `size` [m].
[[nodiscard]] ShapeData scaled_shape(const ParticleTemplate& unit, double size);

}  // namespace scree
