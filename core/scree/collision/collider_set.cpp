#include "scree/collision/collider_set.hpp"

#include <algorithm>
#include <stdexcept>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/collision/simple_pairs.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kBodiesPerChunk = 2048;
/// Low bits of a collider's key hold the ordinal of the primitive.
constexpr unsigned kOrdinalBits = 16;

/// The tight box grown by turning (never beyond the bounding sphere), then swept
/// along the motion of its centre, plus this collider's half of the slack.
Aabb swept(const Aabb& tight, const ColliderMotion& m, const ColliderSpin& spin, const ReachRule& rule) {
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
  return expanded(merged(box, Aabb{box.lower + way, box.upper + way}), 0.5 * (rule.slack * m.radius + rule.skin));
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
  return rule.dt * speed + rule.slack * small.radius + rule.skin;
}

void ColliderSet::note_new_shapes(const ShapeSet& shapes) {
  grow_to(shapes.shapes().size(), shapes_, is_ball_);
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
      record.at_origin = only.local.position == Vec3{};
      record.single_sphere = scree::is_ball(shapes, static_cast<std::uint32_t>(k));
      record.radius = only.bounding_radius;
    }
    shapes_.push_back(record);
    is_ball_.push_back(record.single_sphere ? 1 : 0);
  }
}

/// Counts what is not a single sphere.
void ColliderSet::count_solids(const ShapeSet& shapes, const Shape& shape, const ShapeRecord& record, Place& total) {
  one_each_ &= record.at_origin;
  if (record.planes > 0) {
    std::uint32_t at = total.collider;
    for (const Primitive& primitive : shapes.primitives(shape)) {
      if (!primitive.collides) continue;
      if (primitive.kind == ShapeKind::plane) unbounded_.push_back(at);
      ++at;
    }
  }
  balls_alone_ &= record.planes == record.colliders;
  total.collider += record.colliders;
  total.bounded += record.colliders - std::uint32_t{record.planes};
  total.solid += record.colliders;
}

void ColliderSet::count(const ShapeSet& shapes, const BodyView& bodies) {
  note_new_shapes(shapes);
  chunks_.clear();
  unbounded_.clear();
  one_each_ = true;
  all_spheres_movable_ = true;
  balls_alone_ = !use_.boxes;
  Place total;
  const std::uint32_t* const shape = bodies.shape.data();
  const char* const is_ball = is_ball_.data();
  for (std::size_t first = 0; first < bodies.size(); first += kBodiesPerChunk) {
    chunks_.push_back(total);
    const std::size_t last = std::min(first + kBodiesPerChunk, bodies.size());
    for (std::size_t i = first; i < last; ++i) {
      // Spheres come in runs.
      const std::size_t begin = i;
      while (i < last && is_ball[shape[i]] != 0) ++i;
      total.collider += static_cast<std::uint32_t>(i - begin);
      total.bounded += static_cast<std::uint32_t>(i - begin);
      if (i < last) count_solids(shapes, shapes.shapes()[shape[i]], shapes_[shape[i]], total);
    }
  }
  in_place_ = unbounded_.empty() || balls_alone_;
  make_step_room(total);
}

void ColliderSet::make_step_room(const Place& total) {
  const std::size_t n = total.collider;
  resize_kept(n, key_, body_, primitive_, ordinal_, pose_, movable_, kind_, ball_);
  if (!one_each_) resize_kept(n, own_velocity_);
  if (total.solid > 0) resize_kept(n, solid_of_);
  resize_kept(total.solid, solids_);
  const std::size_t bounded = in_place_ ? n : total.bounded;
  resize_kept(bounded, margin_);
  if (!balls_alone_) resize_kept(bounded, box_);
  if (!in_place_) resize_kept(bounded, bounded_, bounded_key_, bounded_movable_, bounded_owner_, bounded_ball_);
}

/// What is the same for all, or as simple, is written column by column, which a compiler turns into vectors.
void ColliderSet::name_spheres(const BodyView& bodies, std::size_t first, std::size_t last, std::size_t k) {
  const std::size_t n = last - first;
  std::uint64_t* const key = key_.data() + k;
  BodyIndex* const body = body_.data() + k;
  char* const movable = movable_.data() + k;
  const BodyId* const id = bodies.id.data() + first;
  const Motion* const motion = bodies.motion.data() + first;
  for (std::size_t i = 0; i < n; ++i) key[i] = id[i] << kOrdinalBits;
  for (std::size_t i = 0; i < n; ++i) body[i] = static_cast<BodyIndex>(first + i);
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    movable[i] = motion[i] == Motion::dynamic;
    count += motion[i] == Motion::dynamic;
  }
  if (count < n) all_spheres_movable_.store(false, std::memory_order_relaxed);
  std::fill_n(ordinal_.data() + k, n, 0u);
  std::fill_n(kind_.data() + k, n, ShapeKind::sphere);
}

void ColliderSet::place_spheres(const BodyView& bodies, std::size_t first, std::size_t last,
                                std::span<const Vec3> velocity, const ReachRule& rule, Place& at) {
  name_spheres(bodies, first, last, at.collider);
  BoundingBall* const ball = ball_.data();
  std::uint32_t* const primitive = primitive_.data();
  double* const margin = margin_.data();
  for (std::size_t i = first; i < last; ++i) {
    const ShapeRecord shape = shapes_[bodies.shape[i]];
    const std::uint32_t k = at.collider;
    const ColliderMotion motion{bodies.position[i], shape.radius, velocity[i]};
    ball[k] = {motion.centre, motion.radius};
    primitive[k] = shape.first_primitive;
    if (balls_alone_) {
      margin[k] = margin_of(motion, rule);
    } else {
      place_bounded(at, swept_sphere(motion, rule), margin_of(motion, rule));
    }
    if (!one_each_) own_velocity_[k] = motion.velocity;
    if (use_.sphere_poses) pose_[k] = {motion.centre, bodies.orientation[i]};
    ++at.collider;
    ++at.bounded;
  }
}

void ColliderSet::place(const ShapeSet& shapes, const BodyView& bodies, BodyIndex i, const Vec3& velocity,
                        const Vec3& spin, const ReachRule& rule, Place& at) {
  const Shape& shape = shapes.shapes()[bodies.shape[i]];
  const Pose body_pose{bodies.position[i], bodies.orientation[i]};
  for (std::uint32_t ordinal = 0; ordinal < shape.primitive_count; ++ordinal) {
    const Primitive& primitive = shapes.primitives()[shape.first_primitive + ordinal];
    if (!primitive.collides) continue;
    const std::uint32_t k = at.collider;
    key_[k] = (bodies.id[i] << kOrdinalBits) | ordinal;
    body_[k] = i;
    primitive_[k] = shape.first_primitive + ordinal;
    ordinal_[k] = ordinal;
    pose_[k] = body_pose * primitive.local;
    movable_[k] = bodies.motion[i] == Motion::dynamic;
    kind_[k] = primitive.kind;
    const Vec3 centre = pose_[k].position;
    const ColliderMotion motion{centre, primitive.bounding_radius, velocity + cross(spin, centre - body_pose.position)};
    ball_[k] = {motion.centre, motion.radius};
    if (!one_each_) own_velocity_[k] = motion.velocity;
    const bool plane = primitive.kind == ShapeKind::plane;
    Solid& solid = solids_[at.solid];
    solid_of_[k] = at.solid++;
    if (primitive.kind == ShapeKind::sphere) {
      solid.swept = swept_sphere(motion, rule);
    } else {
      solid.spin = {spin, primitive.bounding_radius};
      solid.tight = bounds(shapes, primitive, pose_[k]);
      solid.swept = plane ? Aabb::everywhere() : swept(solid.tight, motion, solid.spin, rule);
    }
    if (balls_alone_) {
      margin_[k] = 0.0;  // of a plane
    } else if (!plane) {
      place_bounded(at, solid.swept, margin_of(motion, rule));
    }
    ++at.collider;
    if (!plane) ++at.bounded;
  }
}

/// Box and ball of a collider within the step.
void ColliderSet::place_bounded(const Place& at, const Aabb& box, double margin) {
  // A body that diverged. Broad phases need numbers; no later test lets it pass, and the stepper reports it.
  const bool bounded = is_bounded(box);
  box_[at.bounded] = bounded ? box : Aabb{};
  margin_[at.bounded] = bounded ? margin : 0.0;
  if (in_place_) return;
  bounded_[at.bounded] = at.collider;
  bounded_key_[at.bounded] = key_[at.collider];
  bounded_movable_[at.bounded] = movable_[at.collider];
  bounded_owner_[at.bounded] = body_[at.collider];
  bounded_ball_[at.bounded] = ball_[at.collider];
}

void ColliderSet::build(const ShapeSet& shapes, const BodyView& bodies, std::span<const Vec3> velocity,
                        std::span<const Vec3> angular_velocity, const ReachRule& rule, const ColliderUse& use,
                        const Executor& executor) {
  SCREE_REQUIRE(velocity.size() == bodies.size() && angular_velocity.size() == bodies.size(),
                "collision needs one velocity and one angular velocity per body");
  use_ = use;
  count(shapes, bodies);
  velocity_ = one_each_ ? velocity : std::span<const Vec3>{own_velocity_};
  executor.for_chunks(bodies.size(), kBodiesPerChunk, [&](std::size_t first, std::size_t last) {
    Place at = chunks_[first / kBodiesPerChunk];
    for (std::size_t i = first; i < last;) {
      // Spheres come in runs.
      std::size_t end = i;
      while (end < last && is_ball_[bodies.shape[end]] != 0) ++end;
      place_spheres(bodies, i, end, velocity, rule, at);
      i = end;
      if (i == last) break;
      place(shapes, bodies, static_cast<BodyIndex>(i), velocity[i], angular_velocity[i], rule, at);
      ++i;
    }
  });
}

void ColliderSet::follow(const ShapeSet& shapes, const BodyView& bodies, std::span<const ColliderIndex> which,
                         const Executor& executor) {
  executor.for_chunks(which.size(), kBodiesPerChunk, [&](std::size_t first, std::size_t last) {
    for (const ColliderIndex k : which.subspan(first, last - first)) {
      const BodyIndex i = body_[k];
      if (shapes_[bodies.shape[i]].single_sphere) {
        ball_[k].centre = bodies.position[i];
        if (use_.sphere_poses) pose_[k] = {bodies.position[i], bodies.orientation[i]};
        continue;
      }
      pose_[k] = Pose{bodies.position[i], bodies.orientation[i]} * shapes.primitives()[primitive_[k]].local;
      ball_[k].centre = pose_[k].position;
    }
  });
}

ColliderView ColliderSet::view() const { return {key_, body_, primitive_, ordinal_, pose_, movable_, kind_, ball_}; }

void ColliderSet::release_bounded() {
  release(box_, margin_, bounded_key_, bounded_movable_, bounded_owner_, bounded_ball_);
}

void ColliderSet::release_step() {
  release_bounded();
  velocity_ = {};
  release(chunks_, key_, body_, primitive_, ordinal_, pose_, movable_, kind_, ball_, own_velocity_, solid_of_, solids_,
          unbounded_, bounded_);
}

BoxView ColliderSet::bounded() const {
  if (in_place_) return {key_, box_, movable_, body_, ball_, margin_};
  return {bounded_key_, box_, bounded_movable_, bounded_owner_, bounded_ball_, margin_};
}

}  // namespace scree
