// Mass properties: volume, centre and inertia of a solid of unit density, in closed form or by exact integrals.
//
// Glossary
//   V    volume [m^3]
//   c    centre of volume [m], in the shape's frame
//   S    second moments about a point, S_ij = integral of x_i x_j dV [m^5]
//   I    inertia per density about c, I = trace(S) 1 - S [kg m^2 / (kg/m^3) = m^5]
//   R    principal axes as columns, in the shape's frame: I = R diag(I1, I2, I3) R^T
// The mass is density V and the inertia is density I.
#pragma once

#include <span>

#include "scree/geometry/sphere.hpp"
#include "scree/geometry/triangle_mesh_data.hpp"
#include "scree/math/pose.hpp"

namespace scree {

/// Volume, centre and principal inertia of a solid, per unit of density.
struct MassProperties {
  double volume = 0.0;  ///< [m^3]
  Vec3 centre;          ///< [m], in the shape's frame
  Vec3 inertia;         ///< principal moments about the centre per density [m^5]
  Quat orientation;     ///< principal axes (columns) in the shape's frame, right-handed
};

/// Raw integrals over a solid; they add, which mass properties do not.
struct VolumeMoments {
  double volume = 0.0;  ///< [m^3]
  Vec3 first;           ///< integral of x dV [m^4]
  Mat3 second;          ///< integral of x x^T dV [m^5], about the origin

  VolumeMoments& operator+=(const VolumeMoments& other);
};

/// The mass properties that belong to raw moments.
///
/// The principal axes come in the order and with the signs that turn the frame least; a frame that is principal
/// already (off-diagonal parts below 1e-9 of the trace) gives exactly the identity.
/// @throws Error (usage) when the volume is not positive and finite.
[[nodiscard]] MassProperties to_mass_properties(const VolumeMoments& moments);

/// The raw moments of mass properties, in the same frame.
[[nodiscard]] VolumeMoments to_moments(const MassProperties& properties);

/// The inertia matrix about the centre per density [m^5], in the shape's frame.
[[nodiscard]] Mat3 inertia_matrix(const MassProperties& properties);

/// Ball of radius [m] about the origin.
[[nodiscard]] MassProperties sphere_mass_properties(double radius);
/// Box of half lengths [m] about the origin.
[[nodiscard]] MassProperties box_mass_properties(const Vec3& half_lengths);
/// Solid cylinder along z about the origin. @param radius [m] @param half_length [m]
[[nodiscard]] MassProperties cylinder_mass_properties(double radius, double half_length);
/// Capsule along z about the origin. @param radius [m] @param half_length [m], of the cylindrical part only
[[nodiscard]] MassProperties capsule_mass_properties(double radius, double half_length);
/// Solid cone along z: base at z = -half_height, apex at z = +half_height, origin at the middle of the height, so that
/// the centre lies at z = -half_height / 2. @param radius of the base [m] @param half_height [m]
[[nodiscard]] MassProperties cone_mass_properties(double radius, double half_height);

/// Solid ellipsoid of the given half axes [m].
[[nodiscard]] MassProperties ellipsoid_mass_properties(const Vec3& half_axes);

/// The solid inside a closed mesh, by exact polyhedral integrals (sum over signed tetrahedra: Eberly, "Polyhedral mass
/// properties", 2002, gives the same polynomials). @throws Error (usage) when the mesh is not a solid, with the reason.
[[nodiscard]] MassProperties mesh_mass_properties(const TriangleMesh& mesh);

/// The union of balls, overlaps counted once; see sphere_union.hpp for the method and its accuracy (1e-6 relative).
/// @throws Error (usage) when there is no ball, or one with a radius that is not positive.
[[nodiscard]] MassProperties cluster_mass_properties(std::span<const Sphere> spheres);

/// A solid of properties `part`, whose frame is placed at `pose` in the frame of the result.
[[nodiscard]] MassProperties placed(const MassProperties& part, const Pose& pose);

/// The solid scaled about the frame's origin by `factor` > 0.
[[nodiscard]] MassProperties scaled(const MassProperties& part, double factor);

/// A part of a composed body.
struct WeightedPart {
  MassProperties properties;  ///< in the frame of the whole
  double density = 1.0;       ///< relative to the density of the whole [1]; negative cuts a hole
};

/// Several parts as one, by the parallel-axes theorem; what overlaps counts twice. The `volume` of the result is the
/// sum of density times volume, so that the density of the whole times it is the mass.
/// @throws Error (usage) when the sum of the volumes is not positive.
[[nodiscard]] MassProperties composed(std::span<const WeightedPart> parts);
/// The same, all parts of the density of the whole.
[[nodiscard]] MassProperties composed(std::span<const MassProperties> parts);

/// Diameter of the sphere of equal volume [m].
[[nodiscard]] double equivalent_diameter(double volume);

}  // namespace scree
