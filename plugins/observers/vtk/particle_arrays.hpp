// The arrays that describe particles in a file: every column of the bodies, and every attribute.
#pragma once

#include "scree/model/body.hpp"
#include "scree/model/shape_set.hpp"
#include "vtp/poly_data.hpp"

namespace scree {

/// One point per body of `which`: id, type (ShapeKind; kShapeKindCount for a compound), shape, material, radius [m],
/// mass [kg], charge [C], velocity [m/s], angular_velocity [rad/s], orientation_wxyz, and every attribute column.
///
/// `charge` is the column of that name, or else the sum of all columns in C.
[[nodiscard]] PolyData particle_data(const BodyView& bodies, std::span<const BodyIndex> which, const ShapeSet& shapes,
                                     Precision precision);

/// One point per sphere of every body of `which`: id of the body, type, material, radius of the sphere [m], charge [C] and
/// velocity of the sphere's centre [m/s].
[[nodiscard]] PolyData sphere_data(const BodyView& bodies, std::span<const BodyIndex> which, const ShapeSet& shapes,
                                   Precision precision);

}  // namespace scree
