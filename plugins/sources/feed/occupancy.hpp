// Occupancy: the bounding spheres around a place of birth, so that no particle is born into another.
#pragma once

#include <vector>

#include "scree/math/aabb.hpp"
#include "scree/model/body.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// Bounding spheres of the dynamic bodies near a region.
class Occupancy {
 public:
  /// Collects the bodies whose bounding sphere meets `region` [m].
  void collect(const BodyView& bodies, const ShapeSet& shapes, const Aabb& region);
  /// True when a sphere of this centre and radius [m] meets none of them.
  [[nodiscard]] bool is_free(const Vec3& centre, double radius) const;
  /// Adds one.
  void add(const Vec3& centre, double radius) { spheres_.push_back({centre, radius}); }

 private:
  std::vector<Sphere> spheres_;
};

}  // namespace scree
