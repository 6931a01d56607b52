// Occupancy: the bounding spheres around a place of birth, so that no particle is born into another.
#pragma once

#include <vector>

#include "scree/math/aabb.hpp"
#include "scree/model/body.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// Bounding spheres of the dynamic bodies near a region, and of those born there in this step.
class Occupancy {
 public:
  /// Forgets everything, for the next step.
  void clear();
  /// Collects the bodies whose bounding sphere meets `region` [m]; what was added stays.
  void collect(const BodyView& bodies, const ShapeSet& shapes, const Aabb& region);
  /// True when a sphere of this centre and radius [m] meets none of them.
  [[nodiscard]] bool is_free(const Vec3& centre, double radius) const;
  /// Adds one that is born.
  void add(const Vec3& centre, double radius) { born_.push_back({centre, radius}); }

 private:
  std::vector<Sphere> bodies_;
  std::vector<Sphere> born_;
};

}  // namespace scree
