#include "bullet.hpp"

#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <limits>

#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

btVector3 to_bullet(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Pose& pose) {
  const Quat& q = pose.orientation;
  return btTransform{btQuaternion{q.x, q.y, q.z, q.w}, to_bullet(pose.position)};
}

/// A solid as Bullet asks for it, in its own frame, with its ball or without.
class BulletShape final : public btConvexInternalShape {
 public:
  BulletShape(const convex::ConvexSolid& solid, bool round) : solid_{solid}, round_{round ? solid.round : 0.0} {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    m_collisionMargin = 0.0;
  }
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& d) const override {
    const Vec3 direction = from_bullet(d);
    Vec3 point = convex::local_core_support(solid_, direction);
    if (round_ > 0.0) point += round_ * normalized(direction);
    return to_bullet(point);
  }
  btVector3 localGetSupportingVertex(const btVector3& d) const override {
    return localGetSupportingVertexWithoutMargin(d);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* d, btVector3* out, int count) const override {
    for (int i = 0; i < count; ++i) out[i] = localGetSupportingVertexWithoutMargin(d[i]);
  }
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "scree"; }

 private:
  const convex::ConvexSolid& solid_;
  double round_;
};

}  // namespace

convex::Answer BulletNarrowPhase::ask(const convex::ConvexSolid& a, const convex::ConvexSolid& b) const {
  const btTransform pose_a = to_bullet(a.pose), pose_b = to_bullet(b.pose);
  const btVector3 guess = to_bullet(b.pose.position - a.pose.position);
  btGjkEpaSolver2::sResults found;
  const BulletShape core_a{a, false}, core_b{b, false};
  convex::Answer answer;
  answer.distance = std::numeric_limits<double>::quiet_NaN();
  if (btGjkEpaSolver2::Distance(&core_a, pose_a, &core_b, pose_b, guess, found)) {
    answer.on_a = from_bullet(found.witnesses[0]);
    answer.on_b = from_bullet(found.witnesses[1]);
    answer.normal = answer.on_b - answer.on_a;
    answer.distance = norm(answer.normal);
    return answer;
  }
  const BulletShape shape_a{a, true}, shape_b{b, true};
  answer.of_cores = false;
  if (btGjkEpaSolver2::Penetration(&shape_a, pose_a, &shape_b, pose_b, guess, found, false)) {
    answer.on_a = from_bullet(found.witnesses[0]);
    answer.on_b = from_bullet(found.witnesses[1]);
    answer.normal = rotate(a.pose.orientation, from_bullet(found.normal));  // it is in the frame of a, unlike all else
    answer.distance = -norm(answer.on_b - answer.on_a);
  }
  return answer;
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins
      .add<scree::NarrowPhase, scree::BulletNarrowPhase>("bullet",
                                                         "Bullet's GJK and EPA on all kinds; where they fail: the best "
                                                         "of climbs over directions. No hollow cylinders.")
      .default_place = 3;
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("bullet", "1.0.0", &list)};
