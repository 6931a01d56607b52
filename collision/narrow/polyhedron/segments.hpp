// Two segments: the closed form of two capsules (Ericson 2005, "Real-time collision detection", section 5.1.9).
#pragma once

#include <array>

#include "manifold.hpp"

namespace scree::polyhedron {

/// The nearest points of the segments from p to p + u and from q to q + v [m]. Parallel ones give the middle of what they share.
[[nodiscard]] std::array<Vec3, 2> nearest_of_segments(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v);

/// How two segments meet. Where they cross, the normal is across both.
[[nodiscard]] Meeting meeting_of_segments(const PlacedPair& pair);

}  // namespace scree::polyhedron
