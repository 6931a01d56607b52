// The points of a solid that can touch a plane.
#pragma once

#include <vector>

#include "solid.hpp"

namespace scree::sphere_cluster {

/// Small spheres (radius 0: points), in the solid's frame [m], that stand for the
/// solid against a plane whose outward normal is `up` in that frame: corners of a
/// box, hull or mesh; ends of a capsule; three points a disc of a cylinder or
/// cone, the lowest one first; the apex of a cone. Their order is the feature.
void support_points(const SolidSet& set, const Solid& solid, const Vec3& up, std::vector<Sphere>& out);

}  // namespace scree::sphere_cluster
