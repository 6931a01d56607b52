// ColliderSet: places the primitives of all bodies in the world and says how
// far each of them can come within the step.
#pragma once

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "scree/base/uninitialised.hpp"
#include "scree/collision/collider.hpp"
#include "scree/interfaces/broad_phase.hpp"

namespace scree {

class Executor;

/// What decides whether two colliders can meet.
struct ColliderMotion {
  Vec3 centre;          ///< of the bounding sphere [m], world
  double radius = 0.0;  ///< of the bounding sphere [m]; infinite for a plane
  Vec3 velocity;        ///< of the centre [m/s], world
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
  double skin = 0.0;   ///< added to that, the same for all [m]
};

/// A bound on how much the gap of two colliders can shrink within the step [m]:
/// relative velocity at the smaller one, plus what their relative spin does over
/// its size, times dt; plus the slack. Bodies that move together pay nothing.
[[nodiscard]] double reach_of(const ColliderMotion& a, const ColliderSpin& spin_a, const ColliderMotion& b,
                              const ColliderSpin& spin_b, const ReachRule& rule);
/// The same for two spheres.
[[nodiscard]] inline double reach_of_spheres(const ColliderMotion& a, const ColliderMotion& b, const ReachRule& rule) {
  return rule.dt * norm(a.velocity - b.velocity) + rule.slack * std::min(a.radius, b.radius) + rule.skin;
}
/// The box of a sphere swept along its motion and grown by its half of the slack [m], world.
[[nodiscard]] inline Aabb swept_sphere(const ColliderMotion& m, const ReachRule& rule) {
  const Vec3 way = rule.dt * m.velocity;
  const double grown = m.radius + 0.5 * (rule.slack * m.radius + rule.skin);
  return {{m.centre.x + std::min(0.0, way.x) - grown, m.centre.y + std::min(0.0, way.y) - grown,
           m.centre.z + std::min(0.0, way.z) - grown},
          {m.centre.x + std::max(0.0, way.x) + grown, m.centre.y + std::max(0.0, way.y) + grown,
           m.centre.z + std::max(0.0, way.z) + grown}};
}
/// What all its motion, in whatever direction, and its half of the slack add to a bounding ball [m].
[[nodiscard]] inline double margin_of(const ColliderMotion& m, const ReachRule& rule) {
  return rule.dt * norm(m.velocity) + 0.5 * (rule.slack * m.radius + rule.skin);
}
/// The bounding ball grown by that: two colliders whose grown balls are apart do not meet within the step. For spheres,
/// reach_of_spheres() says no less.
[[nodiscard]] inline BoundingBall grown_ball(const ColliderMotion& m, const ReachRule& rule) {
  return {m.centre, m.radius + margin_of(m, rule)};
}
/// True when two balls share a point.
[[nodiscard]] inline bool balls_meet(const BoundingBall& a, const BoundingBall& b) {
  const double radii = a.radius + b.radius;
  return squared_norm(b.centre - a.centre) <= radii * radii;
}

/// What the phases of a pipeline read, so that the rest need not be written.
struct ColliderUse {
  bool boxes = true;         ///< false: the broad phase takes balls alone
  bool sphere_poses = true;  ///< some narrow phase reads the poses of spheres
};

/// The colliders of one step. All buffers are kept between steps.
class ColliderSet {
 public:
  /// Places all colliding primitives. `velocity` [m/s] and `angular_velocity` [rad/s], world, one per body, are those
  /// expected over the step; they outlive what is read of this set.
  void build(const ShapeSet& shapes, const BodyView& bodies, std::span<const Vec3> velocity,
             std::span<const Vec3> angular_velocity, const ReachRule& rule, const ColliderUse& use,
             const Executor& executor);

  /// Puts the colliders of `which`, in order, where their bodies are now. Boxes, and what velocities say, stay as built.
  void follow(const ShapeSet& shapes, const BodyView& bodies, std::span<const ColliderIndex> which,
              const Executor& executor);

  [[nodiscard]] ColliderView view() const;
  [[nodiscard]] std::size_t size() const { return key_.size(); }
  /// True when collider i is the only one of body i, for all bodies.
  [[nodiscard]] bool one_each() const { return one_each_; }
  /// True when all but planes are spheres, each a body of its own, and bounded() has no boxes.
  [[nodiscard]] bool balls_alone() const { return balls_alone_; }
  /// True when no sphere that is a body of its own belongs to a body that forces do not move.
  [[nodiscard]] bool all_spheres_movable() const { return all_spheres_movable_; }
  [[nodiscard]] ColliderMotion motion(ColliderIndex i) const {
    return {ball_[i].centre, ball_[i].radius, velocity_[i]};
  }
  [[nodiscard]] std::span<const Vec3> velocity() const { return velocity_; }
  /// True when bodies of a shape have one collider, a sphere about the body's origin. Of shapes seen by build().
  [[nodiscard]] bool is_ball(std::uint32_t shape) const { return shapes_[shape].single_sphere; }
  [[nodiscard]] ColliderSpin spin(ColliderIndex i) const {
    return kind_[i] == ShapeKind::sphere ? ColliderSpin{} : solids_[solid_of_[i]].spin;
  }
  /// The box of a collider without the step's motion [m], world.
  [[nodiscard]] Aabb tight_box(ColliderIndex i) const {
    if (kind_[i] != ShapeKind::sphere) return solids_[solid_of_[i]].tight;
    return expanded(Aabb{ball_[i].centre, ball_[i].centre}, ball_[i].radius);
  }
  /// The tight box grown by what can happen within the step [m], world.
  [[nodiscard]] Aabb swept_box(ColliderIndex i, const ReachRule& rule) const {
    return kind_[i] == ShapeKind::sphere ? swept_sphere(motion(i), rule) : solids_[solid_of_[i]].swept;
  }

  /// The bounded colliders, for the broad phase. Their indices are translated by bounded_index(). Where balls are all it
  /// takes, planes are among them, as balls without bounds.
  [[nodiscard]] BoxView bounded() const;
  [[nodiscard]] bool is_translated() const { return !in_place_; }
  [[nodiscard]] ColliderIndex bounded_index(ColliderIndex i) const { return bounded_[i]; }
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
    bool single_sphere : 1 = false;  // one primitive, a sphere at the body's origin
    bool at_origin : 1 = false;      // one collider, at the body's origin
  };
  static_assert(sizeof(ShapeRecord) == 16);
  /// What is known of a collider that is no sphere.
  struct Solid {
    Aabb tight;  // [m]
    Aabb swept;  // [m]
    ColliderSpin spin;
  };
  /// Where something begins among the colliders, the bounded ones and the solids.
  struct Place {
    std::uint32_t collider = 0, bounded = 0, solid = 0;
  };

  void note_new_shapes(const ShapeSet& shapes);
  void count(const ShapeSet& shapes, const BodyView& bodies);
  void count_solids(const ShapeSet& shapes, const Shape& shape, const ShapeRecord& record, Place& total);
  void make_step_room(const Place& total);
  void name_spheres(const BodyView& bodies, std::size_t first, std::size_t last, std::size_t k);
  void place_spheres(const BodyView& bodies, std::size_t first, std::size_t last, std::span<const Vec3> velocity,
                     const ReachRule& rule, Place& at);
  void place(const ShapeSet& shapes, const BodyView& bodies, BodyIndex i, const Vec3& velocity, const Vec3& spin,
             const ReachRule& rule, Place& at);
  void place_bounded(const Place& at, const Aabb& box, double margin);

  ColliderUse use_;
  std::vector<ShapeRecord> shapes_;  // of all shapes so far
  std::vector<char> is_ball_;        // 1 for shapes that are a single sphere: what counting reads of most
  std::vector<Place> chunks_;        // where the bodies of each chunk begin
  bool one_each_ = true, balls_alone_ = false;
  std::atomic<bool> all_spheres_movable_ = true;
  UninitialisedVector<std::uint64_t> key_;
  UninitialisedVector<BodyIndex> body_;
  UninitialisedVector<std::uint32_t> primitive_;
  UninitialisedVector<std::uint32_t> ordinal_;
  UninitialisedVector<Pose> pose_;
  UninitialisedVector<char> movable_;
  UninitialisedVector<ShapeKind> kind_;
  UninitialisedVector<BoundingBall> ball_;
  std::span<const Vec3> velocity_;               // of the bodies, or what follows
  UninitialisedVector<Vec3> own_velocity_;       // where a body's is not its colliders'
  UninitialisedVector<std::uint32_t> solid_of_;  // empty where all are spheres
  UninitialisedVector<Solid> solids_;

  // Of the bounded ones. What is the same as above is there alone, unless planes stand between.
  bool in_place_ = true;
  std::vector<ColliderIndex> unbounded_;
  UninitialisedVector<Aabb> box_;
  UninitialisedVector<double> margin_;
  UninitialisedVector<ColliderIndex> bounded_;
  UninitialisedVector<std::uint64_t> bounded_key_;
  UninitialisedVector<char> bounded_movable_;
  UninitialisedVector<std::uint32_t> bounded_owner_;
  UninitialisedVector<BoundingBall> bounded_ball_;
};

}  // namespace scree
