// Pairs of single spheres, four at a time.
#pragma once

#include <span>

#include "scree/collision/collider.hpp"
#include "scree/collision/contact.hpp"

namespace scree::sphere_cluster {

/// Appends the contacts of pairs of which both are spheres, in order.
void collide_spheres(const ColliderView& colliders, std::span<const ColliderPair> pairs, ContactBuffer& out);

}  // namespace scree::sphere_cluster
