// Roll: the turning cylinder that grains cling to, as its axis, radius and half length.
#pragma once

#include <string>

#include "scree/math/vec3.hpp"

namespace scree {

class SceneServices;

/// A cylinder that may turn about its axis but does not leave its place.
struct Roll {
  Vec3 centre;               ///< middle of the axis [m], world
  Vec3 axis;                 ///< unit [1], world; of both directions the one with the larger sum of components
  double radius = 0.0;       ///< [m]
  double half_length = 0.0;  ///< [m]
};

/// A point in the cylindrical coordinates of a roll.
struct RollCoordinates {
  Vec3 radial;            ///< from the axis to the point, perpendicular to the axis [m], world
  double distance = 0.0;  ///< of the point from the axis [m]
  double along = 0.0;     ///< from the middle of the roll, along its axis [m]
};

[[nodiscard]] inline RollCoordinates to_roll(const Roll& roll, const Vec3& point) {
  const Vec3 offset = point - roll.centre;
  const double along = dot(offset, roll.axis);
  const Vec3 radial = offset - along * roll.axis;
  return {radial, norm(radial), along};
}

/// The roll that is the body `name` of the scene, from the one cylinder of its shape.
/// @throws Error (usage) when there is no such body, or its shape has no cylinder.
[[nodiscard]] Roll find_roll(SceneServices& services, const std::string& name);

}  // namespace scree
