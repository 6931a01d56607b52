// Nearest point of a convex hull.
#pragma once

#include "nearest.hpp"
#include "scree/model/shape_set.hpp"

namespace scree::sphere_cluster {

/// Signed distance of p [m] from a hull, in the hull's frame. Beyond `limit` [m]
/// the distance may be too small, but stays above `limit`.
[[nodiscard]] Nearest nearest_on_hull(const ShapeSet& shapes, const Primitive& hull, const Vec3& p, double limit);

}  // namespace scree::sphere_cluster
