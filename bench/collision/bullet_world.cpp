#include <btBulletCollisionCommon.h>

#include <algorithm>

#include "world.hpp"

namespace scree::bench {
namespace {

btVector3 to_bullet(const Vec3& v, double scale) { return {scale * v.x, scale * v.y, scale * v.z}; }

class BulletWorld final : public Contender {
 public:
  BulletWorld(const World& world, double scale) : scale_{scale / world.mean_radius} {
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.hull.empty()) {
        shapes_.push_back(std::make_unique<btSphereShape>(scale_ * world.radius[i]));
      } else {
        auto hull = std::make_unique<btConvexHullShape>();
        for (const Vec3& p : world.hull[i]) hull->addPoint(to_bullet(p, scale_), false);
        hull->recalcLocalAabb();
        hull->setMargin(0.01 * scale);
        shapes_.push_back(std::move(hull));
      }
      objects_.push_back(std::make_unique<btCollisionObject>());
      objects_[i]->setCollisionShape(shapes_[i].get());
      objects_[i]->setUserIndex(static_cast<int>(i));
      const Quat& q = world.orientation[i];
      objects_[i]->setWorldTransform(
          btTransform{btQuaternion{q.x, q.y, q.z, q.w}, to_bullet(world.position[i], scale_)});
      world_.addCollisionObject(objects_[i].get());
    }
  }
  ~BulletWorld() override {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  std::size_t frame(const std::vector<Vec3>& position) override {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      objects_[i]->getWorldTransform().setOrigin(to_bullet(position[i], scale_));
    }
    world_.performDiscreteCollisionDetection();
    std::size_t contacts = 0;
    for (int k = 0; k < dispatcher_.getNumManifolds(); ++k) {
      contacts += static_cast<std::size_t>(dispatcher_.getManifoldByIndexInternal(k)->getNumContacts());
    }
    return contacts;
  }

  [[nodiscard]] std::vector<Touch> touches() const override {
    std::vector<Touch> out;
    for (int k = 0; k < dispatcher_.getNumManifolds(); ++k) {
      const btPersistentManifold* manifold =
          const_cast<btCollisionDispatcher&>(dispatcher_).getManifoldByIndexInternal(k);
      double gap = 1.0;
      for (int c = 0; c < manifold->getNumContacts(); ++c) {
        gap = std::min(gap, double{manifold->getContactPoint(c).getDistance()} / scale_);
      }
      if (gap > 0.0) continue;
      const auto a = static_cast<std::uint32_t>(manifold->getBody0()->getUserIndex());
      const auto b = static_cast<std::uint32_t>(manifold->getBody1()->getUserIndex());
      out.push_back({std::min(a, b), std::max(a, b), gap});
    }
    std::ranges::sort(out, {}, [](const Touch& t) { return std::pair{t.a, t.b}; });
    return out;
  }

 private:
  double scale_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broad_;
  btCollisionWorld world_{&dispatcher_, &broad_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace

std::unique_ptr<Contender> make_bullet_world(const World& world, double scale) {
  return std::make_unique<BulletWorld>(world, scale);
}

}  // namespace scree::bench
