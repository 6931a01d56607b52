// Pose: a rigid placement, position and orientation of one frame in another.
#pragma once

#include "scree/math/quat.hpp"

namespace scree {

/// Where a frame sits in its parent frame: x_parent = position + orientation x_local.
struct Pose {
  Vec3 position;     ///< [m], in the parent frame
  Quat orientation;  ///< local to parent, unit

  constexpr bool operator==(const Pose&) const = default;
};

constexpr Vec3 transform(const Pose& p, const Vec3& local) { return p.position + rotate(p.orientation, local); }
constexpr Vec3 transform_back(const Pose& p, const Vec3& parent) {
  return rotate_back(p.orientation, parent - p.position);
}
constexpr Pose operator*(const Pose& parent, const Pose& child) {
  return {transform(parent, child.position), parent.orientation * child.orientation};
}
constexpr Pose inverse(const Pose& p) { return {-rotate_back(p.orientation, p.position), conjugate(p.orientation)}; }

}  // namespace scree
