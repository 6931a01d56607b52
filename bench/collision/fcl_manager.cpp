#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <tuple>

#include "scree/geometry/convex_hull.hpp"
#include "world.hpp"

namespace scree::bench {
namespace {

using Object = fcl::CollisionObjectd;

std::shared_ptr<fcl::CollisionGeometryd> hull_of(const std::vector<Vec3>& points) {
  const ConvexHull hull = convex_hull(points);
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3& v : hull.vertices) vertices->emplace_back(v.x, v.y, v.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const Triangle& t : hull.triangles) {
    faces->push_back(3);
    for (const auto corner : t) faces->push_back(static_cast<int>(corner));
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull.triangles.size()), faces);
}

class FclManager final : public Contender {
 public:
  explicit FclManager(const World& world) {
    std::vector<Object*> all;
    for (std::size_t i = 0; i < world.size(); ++i) {
      std::shared_ptr<fcl::CollisionGeometryd> shape;
      if (world.hull.empty()) {
        shape = std::make_shared<fcl::Sphered>(world.radius[i]);
      } else {
        shape = hull_of(world.hull[i]);
      }
      const Quat& q = world.orientation[i];
      const Vec3& p = world.position[i];
      objects_.push_back(std::make_unique<Object>(shape, fcl::Quaterniond{q.w, q.x, q.y, q.z}.toRotationMatrix(),
                                                  fcl::Vector3d{p.x, p.y, p.z}));
      objects_.back()->computeAABB();
      geometry_.emplace_back(objects_.back()->collisionGeometry().get(), static_cast<std::uint32_t>(i));
      all.push_back(objects_.back().get());
    }
    std::ranges::sort(geometry_);
    manager_.registerObjects(all);
    manager_.setup();
  }

  std::size_t frame(const std::vector<Vec3>& position) override {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      objects_[i]->setTranslation({position[i].x, position[i].y, position[i].z});
      objects_[i]->computeAABB();
    }
    manager_.update();
    data_ = {};
    data_.request.enable_contact = true;
    data_.request.num_max_contacts = std::numeric_limits<std::size_t>::max();
    manager_.collide(&data_, &fcl::DefaultCollisionFunction<double>);
    return data_.result.numContacts();
  }

  [[nodiscard]] std::vector<Touch> touches() const override {
    std::vector<Touch> out;
    for (std::size_t k = 0; k < data_.result.numContacts(); ++k) {
      const fcl::Contactd& contact = data_.result.getContact(k);
      const std::uint32_t a = number_of(contact.o1), b = number_of(contact.o2);
      out.push_back({std::min(a, b), std::max(a, b), -contact.penetration_depth});
    }
    std::ranges::sort(out, {}, [](const Touch& t) { return std::tuple{t.a, t.b, t.gap}; });
    const auto same = [](const Touch& l, const Touch& r) { return l.a == r.a && l.b == r.b; };
    out.erase(std::unique(out.begin(), out.end(), same), out.end());
    return out;
  }

 private:
  [[nodiscard]] std::uint32_t number_of(const fcl::CollisionGeometryd* geometry) const {
    return std::ranges::lower_bound(geometry_, std::pair{geometry, std::uint32_t{0}})->second;
  }

  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<std::pair<const fcl::CollisionGeometryd*, std::uint32_t>> geometry_;  // sorted
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  fcl::DefaultCollisionData<double> data_;
};

}  // namespace

std::unique_ptr<Contender> make_fcl_manager(const World& world) { return std::make_unique<FclManager>(world); }

}  // namespace scree::bench
