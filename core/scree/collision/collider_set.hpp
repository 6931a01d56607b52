// ColliderSet: places the primitives of all bodies in the world and says how
// far each of them can come within the step.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "scree/base/uninitialised.hpp"
#include "scree/collision/collider.hpp"
#include "scree/interfaces/broad_phase.hpp"

namespace scree {

class Executor;

/// What decides whether two colliders can meet: one cache line each, as every candidate pair reads two of them.
struct alignas(64) ColliderMotion {
  Vec3 centre;          ///< of the bounding sphere [m], world
  double radius = 0.0;  ///< of the bounding sphere [m]; infinite for a plane
  Vec3 velocity;        ///< of the centre [m/s], world
  BodyIndex body = 0;
  ShapeKind kind = ShapeKind::sphere;
  bool movable = false;
};

/// How a collider turns. A sphere's own spin does not move its surface and is left out.
struct ColliderSpin {
  Vec3 spin;                 ///< [rad/s], world; zero for a sphere
  double turn_radius = 0.0;  ///< farthest point from the centre that the spin moves [m]
};

/// What decides how far ahead contacts are sought.
struct ReachRule {
  double dt = 0.0;     ///< [s]
  double slack = 0.0;  ///< added to the motion, in bounding radii of the smaller collider [1]
};

/// A bound on how much the gap of two colliders can shrink within the step [m]:
/// relative velocity at the smaller one, plus what their relative spin does over
/// its size, times dt; plus the slack. Bodies that move together pay nothing.
[[nodiscard]] double reach_of(const ColliderMotion& a, const ColliderSpin& spin_a, const ColliderMotion& b,
                              const ColliderSpin& spin_b, const ReachRule& rule);
/// The same for two spheres.
[[nodiscard]] inline double reach_of_spheres(const ColliderMotion& a, const ColliderMotion& b, const ReachRule& rule) {
  return rule.dt * norm(a.velocity - b.velocity) + rule.slack * std::min(a.radius, b.radius);
}
/// The box of a sphere swept along its motion and grown by its half of the slack [m], world.
[[nodiscard]] inline Aabb swept_sphere(const ColliderMotion& m, const ReachRule& rule) {
  const Vec3 way = rule.dt * m.velocity;
  const double grown = m.radius + 0.5 * rule.slack * m.radius;
  return {{m.centre.x + std::min(0.0, way.x) - grown, m.centre.y + std::min(0.0, way.y) - grown,
           m.centre.z + std::min(0.0, way.z) - grown},
          {m.centre.x + std::max(0.0, way.x) + grown, m.centre.y + std::max(0.0, way.y) + grown,
           m.centre.z + std::max(0.0, way.z) + grown}};
}
/// The bounding ball grown by all its motion, in whatever direction, and by its half of the slack [m]: two colliders whose
/// grown balls are apart do not meet within the step. For spheres, reach_of_spheres() says no less.
[[nodiscard]] inline BoundingBall grown_ball(const ColliderMotion& m, const ReachRule& rule) {
  return {m.centre, m.radius + rule.dt * norm(m.velocity) + 0.5 * rule.slack * m.radius};
}
/// True when two balls share a point.
[[nodiscard]] inline bool balls_meet(const BoundingBall& a, const BoundingBall& b) {
  const double radii = a.radius + b.radius;
  return squared_norm(b.centre - a.centre) <= radii * radii;
}

/// The colliders of one step. All buffers are kept between steps.
class ColliderSet {
 public:
  /// Places all colliding primitives. `velocity` [m/s] and `angular_velocity`
  /// [rad/s], world, one per body, are those expected over the step.
  void build(const ShapeSet& shapes, const BodyView& bodies, std::span<const Vec3> velocity,
             std::span<const Vec3> angular_velocity, const ReachRule& rule, const Executor& executor);

  [[nodiscard]] ColliderView view() const;
  [[nodiscard]] std::size_t size() const { return key_.size(); }
  [[nodiscard]] std::span<const ColliderMotion> motion() const { return motion_; }
  [[nodiscard]] ColliderSpin spin(ColliderIndex i) const {
    return kind_[i] == ShapeKind::sphere ? ColliderSpin{} : spin_[i];
  }
  /// The box of a collider without the step's motion [m], world.
  [[nodiscard]] Aabb tight_box(ColliderIndex i) const {
    if (kind_[i] != ShapeKind::sphere) return tight_[i];
    return expanded(Aabb{ball_[i].centre, ball_[i].centre}, ball_[i].radius);
  }

  /// The bounded colliders, for the broad phase. Their indices are translated
  /// by bounded_index().
  [[nodiscard]] BoxView bounded() const;
  [[nodiscard]] ColliderIndex bounded_index(ColliderIndex i) const { return all_bounded_ ? i : bounded_[i]; }
  /// Frees what only bounded() returns.
  void release_bounded();
  /// Frees all that belongs to the step.
  void release_step();
  /// Colliders without bounds: planes.
  [[nodiscard]] std::span<const ColliderIndex> unbounded() const { return unbounded_; }

 private:
  /// What placing needs to know of a shape, in little memory: grains with shapes of their own are many.
  struct ShapeRecord {
    double radius = 0.0;  // of the sphere, if single [m]
    std::uint32_t first_primitive = 0;
    std::uint16_t colliders = 0;
    std::uint8_t planes = 0;
    std::uint8_t single_sphere = 0;  // one primitive, a sphere at the body's origin
  };
  static_assert(sizeof(ShapeRecord) == 16);

  void note_new_shapes(const ShapeSet& shapes);
  void count(const ShapeSet& shapes, const BodyView& bodies);
  void make_step_room(std::uint32_t total);
  void place_spheres(const BodyView& bodies, std::size_t first, std::size_t last, std::span<const Vec3> velocity,
                     const ReachRule& rule);
  void place(const ShapeSet& shapes, const BodyView& bodies, BodyIndex i, const Vec3& velocity, const Vec3& spin,
             const ReachRule& rule);
  void bound(std::uint32_t at, const Aabb& box, const ReachRule& rule);
  void place_bounded(std::uint32_t at, std::uint32_t bounded_at);

  std::vector<ShapeRecord> shapes_;                   // of all shapes so far
  bool all_spheres_ = true;                           // single ones, all bodies of the step
  UninitialisedVector<std::uint32_t> first_;          // collider of each body, one more at the end
  UninitialisedVector<std::uint32_t> first_bounded_;  // the same among the bounded ones
  UninitialisedVector<std::uint64_t> key_;
  UninitialisedVector<BodyIndex> body_;
  UninitialisedVector<std::uint32_t> primitive_;
  UninitialisedVector<std::uint32_t> ordinal_;
  UninitialisedVector<Pose> pose_;
  UninitialisedVector<Aabb> box_;
  UninitialisedVector<Aabb> tight_;  // of what is no sphere; empty when all are
  UninitialisedVector<char> movable_;
  UninitialisedVector<ShapeKind> kind_;
  UninitialisedVector<BoundingBall> ball_;
  UninitialisedVector<ColliderMotion> motion_;
  UninitialisedVector<ColliderSpin> spin_;  // as tight_
  UninitialisedVector<BoundingBall> grown_;

  bool all_bounded_ = true;
  std::vector<ColliderIndex> unbounded_;
  UninitialisedVector<ColliderIndex> bounded_;
  UninitialisedVector<std::uint64_t> bounded_key_;
  UninitialisedVector<Aabb> bounded_box_;
  UninitialisedVector<char> bounded_movable_;
  UninitialisedVector<std::uint32_t> bounded_owner_;
  UninitialisedVector<BoundingBall> bounded_grown_;
};

}  // namespace scree
