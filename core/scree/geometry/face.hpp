// Face: one plane that bounds a convex solid.
#pragma once

#include "scree/math/vec3.hpp"

namespace scree {

/// A face of a convex hull: the solid satisfies dot(normal, x) <= offset.
struct Face {
  Vec3 normal;          ///< outward unit normal [1], shape's frame
  double offset = 0.0;  ///< [m]

  constexpr bool operator==(const Face&) const = default;
};

}  // namespace scree
