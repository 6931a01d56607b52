#include "occupancy.hpp"

#include <algorithm>

namespace scree {

void Occupancy::clear() {
  bodies_.clear();
  born_.clear();
}

void Occupancy::collect(const BodyView& bodies, const ShapeSet& shapes, const Aabb& region) {
  bodies_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] != Motion::dynamic) continue;
    const double radius = shapes.shapes()[bodies.shape[i]].bounding_radius;
    if (contains(expanded(region, radius), bodies.position[i])) bodies_.push_back({bodies.position[i], radius});
  }
}

bool Occupancy::is_free(const Vec3& centre, double radius) const {
  const auto misses = [&](const Sphere& other) {
    const double distance = radius + other.radius;
    return squared_norm(centre - other.centre) >= distance * distance;
  };
  return std::all_of(bodies_.begin(), bodies_.end(), misses) && std::all_of(born_.begin(), born_.end(), misses);
}

}  // namespace scree
