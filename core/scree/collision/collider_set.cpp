#include "scree/collision/collider_set.hpp"

#include <algorithm>
#include <stdexcept>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kBodiesPerChunk = 2048;
/// Low bits of a collider's key hold the ordinal of the primitive.
constexpr unsigned kOrdinalBits = 16;

/// The tight box grown by turning (never beyond the bounding sphere), then swept
/// along the motion of its centre, plus this collider's half of the slack.
Aabb swept_box(const Aabb& tight, const ColliderMotion& m, const ColliderSpin& spin, const ReachRule& rule) {
  Aabb box = tight;
  const double turn = rule.dt * norm(spin.spin) * spin.turn_radius;
  if (turn > 0.0) {
    const Aabb grown = expanded(tight, turn);
    const Aabb ball = expanded(Aabb{m.centre, m.centre}, m.radius);
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::max(grown.lower[axis], std::min(ball.lower[axis], tight.lower[axis]));
      box.upper[axis] = std::min(grown.upper[axis], std::max(ball.upper[axis], tight.upper[axis]));
    }
  }
  const Vec3 way = rule.dt * m.velocity;
  return expanded(merged(box, Aabb{box.lower + way, box.upper + way}), 0.5 * rule.slack * m.radius);
}

}  // namespace

double reach_of(const ColliderMotion& a, const ColliderSpin& spin_a, const ColliderMotion& b,
                const ColliderSpin& spin_b, const ReachRule& rule) {
  const bool a_smaller = a.radius <= b.radius;
  const ColliderMotion& small = a_smaller ? a : b;
  const ColliderMotion& large = a_smaller ? b : a;
  const ColliderSpin& small_spin = a_smaller ? spin_a : spin_b;
  const ColliderSpin& large_spin = a_smaller ? spin_b : spin_a;
  const Vec3 approach = small.velocity - large.velocity - cross(large_spin.spin, small.centre - large.centre);
  double speed = norm(approach);
  if (small_spin.turn_radius > 0.0) speed += norm(small_spin.spin - large_spin.spin) * small_spin.turn_radius;
  return rule.dt * speed + rule.slack * small.radius;
}

void ColliderSet::note_new_shapes(const ShapeSet& shapes) {
  grow_to(shapes.shapes().size(), shapes_);
  for (std::size_t k = shapes_.size(); k < shapes.shapes().size(); ++k) {
    const Shape& shape = shapes.shapes()[k];
    ShapeRecord record;
    record.first_primitive = shape.first_primitive;
    for (const Primitive& primitive : shapes.primitives(shape)) {
      if (!primitive.collides) continue;
      ++record.colliders;
      if (primitive.kind == ShapeKind::plane) ++record.planes;
    }
    if (shape.primitive_count == 1 && record.colliders == 1) {
      const Primitive& only = shapes.primitives()[shape.first_primitive];
      record.single_sphere =
          only.kind == ShapeKind::sphere && only.local.position == Vec3{} && only.local.orientation == Quat{};
      record.radius = only.bounding_radius;
    }
    shapes_.push_back(record);
  }
}

void ColliderSet::make_step_room(std::uint32_t total) {
  key_.resize(total);
  body_.resize(total);
  primitive_.resize(total);
  ordinal_.resize(total);
  pose_.resize(total);
  box_.resize(total);
  movable_.resize(total);
  kind_.resize(total);
  ball_.resize(total);
  motion_.resize(total);
  grown_.resize(total);
  if (!all_spheres_) {
    tight_.resize(total);
    spin_.resize(total);
  }
  if (all_bounded_) return;
  const std::size_t bounded = total - unbounded_.size();
  bounded_.resize(bounded);
  bounded_key_.resize(bounded);
  bounded_box_.resize(bounded);
  bounded_movable_.resize(bounded);
  bounded_owner_.resize(bounded);
  bounded_grown_.resize(bounded);
}

void ColliderSet::count(const ShapeSet& shapes, const BodyView& bodies) {
  note_new_shapes(shapes);
  first_.resize(bodies.size() + 1);
  first_bounded_.resize(bodies.size() + 1);
  unbounded_.clear();
  all_spheres_ = true;
  std::uint32_t total = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    first_[i] = total;
    first_bounded_[i] = total - static_cast<std::uint32_t>(unbounded_.size());
    const ShapeRecord& record = shapes_[bodies.shape[i]];
    all_spheres_ &= record.single_sphere != 0;
    if (record.planes > 0) {
      std::uint32_t at = total;
      for (const Primitive& primitive : shapes.primitives(shapes.shapes()[bodies.shape[i]])) {
        if (!primitive.collides) continue;
        if (primitive.kind == ShapeKind::plane) unbounded_.push_back(at);
        ++at;
      }
    }
    total += record.colliders;
  }
  first_[bodies.size()] = total;
  first_bounded_[bodies.size()] = total - static_cast<std::uint32_t>(unbounded_.size());
  all_bounded_ = unbounded_.empty();
  make_step_room(total);
}

void ColliderSet::place_spheres(const BodyView& bodies, std::size_t first, std::size_t last,
                                std::span<const Vec3> velocity, const ReachRule& rule) {
  for (std::size_t i = first; i < last; ++i) {
    const ShapeRecord shape = shapes_[bodies.shape[i]];
    const Vec3 centre = bodies.position[i];
    const bool movable = bodies.motion[i] == Motion::dynamic;
    const ColliderMotion motion{centre, shape.radius, velocity[i], static_cast<BodyIndex>(i), ShapeKind::sphere,
                                movable};
    const Aabb box = swept_sphere(motion, rule);
    const bool bounded = is_bounded(box);
    const std::uint32_t at = first_[i];
    motion_[at] = motion;
    box_[at] = bounded ? box : Aabb{};
    grown_[at] = bounded ? grown_ball(motion, rule) : BoundingBall{};
    ball_[at] = {centre, shape.radius};
    pose_[at] = {centre, bodies.orientation[i]};
    key_[at] = bodies.id[i] << kOrdinalBits;
    body_[at] = static_cast<BodyIndex>(i);
    primitive_[at] = shape.first_primitive;
    ordinal_[at] = 0;
    kind_[at] = ShapeKind::sphere;
    movable_[at] = movable;
    if (!all_bounded_) place_bounded(at, first_bounded_[i]);
  }
}

/// Box and ball of a collider within the step.
void ColliderSet::bound(std::uint32_t at, const Aabb& box, const ReachRule& rule) {
  // A body that diverged. Broad phases need numbers; no later test lets it pass, and the stepper reports it.
  const bool bounded = is_bounded(box);
  box_[at] = bounded ? box : Aabb{};
  grown_[at] = bounded ? grown_ball(motion_[at], rule) : BoundingBall{};
}

void ColliderSet::place(const ShapeSet& shapes, const BodyView& bodies, BodyIndex i, const Vec3& velocity,
                        const Vec3& spin, const ReachRule& rule) {
  const Shape& shape = shapes.shapes()[bodies.shape[i]];
  const Pose body_pose{bodies.position[i], bodies.orientation[i]};
  std::uint32_t at = first_[i];
  std::uint32_t bounded_at = first_bounded_[i];
  for (std::uint32_t k = 0; k < shape.primitive_count; ++k) {
    const Primitive& primitive = shapes.primitives()[shape.first_primitive + k];
    if (!primitive.collides) continue;
    key_[at] = (bodies.id[i] << kOrdinalBits) | k;
    body_[at] = i;
    primitive_[at] = shape.first_primitive + k;
    ordinal_[at] = k;
    pose_[at] = body_pose * primitive.local;
    movable_[at] = bodies.motion[i] == Motion::dynamic;
    const Vec3 centre = pose_[at].position;
    kind_[at] = primitive.kind;
    ball_[at] = {centre, primitive.bounding_radius};
    motion_[at] = {centre,         primitive.bounding_radius, velocity + cross(spin, centre - body_pose.position), i,
                   primitive.kind, movable_[at] != 0};
    const bool plane = primitive.kind == ShapeKind::plane;
    if (primitive.kind == ShapeKind::sphere) {
      bound(at, swept_sphere(motion_[at], rule), rule);
    } else {
      spin_[at] = {spin, primitive.bounding_radius};
      tight_[at] = bounds(shapes, primitive, pose_[at]);
      bound(at, swept_box(tight_[at], motion_[at], spin_[at], rule), rule);
      if (plane) box_[at] = Aabb::everywhere();
    }
    if (!all_bounded_ && !plane) place_bounded(at, bounded_at++);
    ++at;
  }
}

void ColliderSet::place_bounded(std::uint32_t at, std::uint32_t bounded_at) {
  bounded_[bounded_at] = at;
  bounded_key_[bounded_at] = key_[at];
  bounded_box_[bounded_at] = box_[at];
  bounded_movable_[bounded_at] = movable_[at];
  bounded_owner_[bounded_at] = body_[at];
  bounded_grown_[bounded_at] = grown_[at];
}

void ColliderSet::build(const ShapeSet& shapes, const BodyView& bodies, std::span<const Vec3> velocity,
                        std::span<const Vec3> angular_velocity, const ReachRule& rule, const Executor& executor) {
  SCREE_REQUIRE(velocity.size() == bodies.size() && angular_velocity.size() == bodies.size(),
                "collision needs one velocity and one angular velocity per body");
  count(shapes, bodies);
  executor.for_chunks(bodies.size(), kBodiesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last;) {
      // Spheres come in runs.
      std::size_t end = i;
      while (end < last && shapes_[bodies.shape[end]].single_sphere != 0) ++end;
      place_spheres(bodies, i, end, velocity, rule);
      i = end;
      if (i == last) break;
      place(shapes, bodies, static_cast<BodyIndex>(i), velocity[i], angular_velocity[i], rule);
      ++i;
    }
  });
}

ColliderView ColliderSet::view() const {
  return {key_, body_, primitive_, ordinal_, pose_, box_, movable_, kind_, ball_};
}

void ColliderSet::release_bounded() {
  release(bounded_key_, bounded_box_, bounded_movable_, bounded_owner_, bounded_grown_, grown_);
}

void ColliderSet::release_step() {
  release_bounded();
  release(first_, first_bounded_, key_, body_, primitive_, ordinal_, pose_, box_, tight_, movable_, kind_, ball_,
          motion_, spin_, unbounded_, bounded_);
}

BoxView ColliderSet::bounded() const {
  if (all_bounded_) return {key_, box_, movable_, body_, grown_};
  return {bounded_key_, bounded_box_, bounded_movable_, bounded_owner_, bounded_grown_};
}

}  // namespace scree
