// Shavings: bent, twisted rows of equal balls, the shape of metal chips and wire cuttings.
#pragma once

#include <vector>

#include "scree/geometry/sphere.hpp"

namespace scree {

/// What a shaving looks like. Its centre line has constant curvature bend / l and torsion twist / l over the length
/// l = length - diameter between the first and the last centre: an arc of a circle without twist, else of a helix.
struct ShavingParameters {
  double length = 0.0;    ///< along the centre line from tip to tip [m], at least the diameter
  double diameter = 0.0;  ///< of the balls [m]
  double bend = 0.0;      ///< angle by which the centre line turns from end to end [rad], 0 to 2 pi
  double twist = 0.0;     ///< angle by which the plane of bending turns about the line from end to end [rad]
  int count = 0;          ///< number of balls, 1 to 32; 0: as many as needed for a spacing of half a diameter
};

/// Most balls that a shaving may have.
inline constexpr int kMostShavingSpheres = 32;

/// The balls of a shaving, from end to end, equally spaced along the centre line. The middle of the line is the origin;
/// there the line runs along x and bends towards y. Volume and inertia: cluster_mass_properties().
/// @throws Error (usage) for sizes that are not positive, a length below the diameter, an angle out of range, a count
/// out of range, and balls so few that neighbours do not meet.
[[nodiscard]] std::vector<Sphere> shaving_spheres(const ShavingParameters& parameters);

}  // namespace scree
