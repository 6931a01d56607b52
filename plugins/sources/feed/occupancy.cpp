#include "occupancy.hpp"

namespace scree {

void Occupancy::collect(const BodyView& bodies, const ShapeSet& shapes, const Aabb& region) {
  spheres_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] != Motion::dynamic) continue;
    const double radius = shapes.shapes()[bodies.shape[i]].bounding_radius;
    if (contains(expanded(region, radius), bodies.position[i])) spheres_.push_back({bodies.position[i], radius});
  }
}

bool Occupancy::is_free(const Vec3& centre, double radius) const {
  for (const Sphere& other : spheres_) {
    const double distance = radius + other.radius;
    if (squared_norm(centre - other.centre) < distance * distance) return false;
  }
  return true;
}

}  // namespace scree
