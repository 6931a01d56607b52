// Sphere: a ball, the part from which clusters are made.
#pragma once

#include "scree/math/vec3.hpp"

namespace scree {

/// A ball, given in the frame of the shape that it belongs to.
struct Sphere {
  Vec3 centre;          ///< [m], shape frame
  double radius = 0.0;  ///< [m]

  constexpr bool operator==(const Sphere&) const = default;
};

}  // namespace scree
