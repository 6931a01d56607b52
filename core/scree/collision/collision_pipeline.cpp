#include "scree/collision/collision_pipeline.hpp"

#include <algorithm>
#include <functional>
#include <string>

#include "scree/base/release.hpp"
#include "scree/collision/collider_kind.hpp"
#include "scree/collision/swept_spheres.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

using collider_kind::index;
using collider_kind::kKinds;
using collider_kind::unsupported;

constexpr std::size_t kCandidatesPerChunk = 8192;
constexpr std::size_t kCollidersPerChunk = 512;
/// Below, all buffers but the contacts take ten megabytes, and are kept.
constexpr std::size_t kManyBodies = std::size_t{1} << 16;

/// Candidates ahead of the present one whose records are fetched into the cache.
constexpr std::size_t kPrefetch = 16;

}  // namespace

CollisionPipeline::CollisionPipeline(const ShapeSet& shapes, BroadPhase& broad, std::vector<NarrowPhase*> chain,
                                     const Executor& executor, const CollisionSettings& settings)
    : shapes_{shapes}, broad_{broad}, chain_{std::move(chain)}, executor_{executor}, settings_{settings} {
  for (std::size_t a = 0; a < kKinds; ++a) {
    for (std::size_t b = 0; b < kKinds; ++b) {
      const auto first = std::find_if(chain_.begin(), chain_.end(),
                                      [&](const NarrowPhase* phase) { return collider_kind::supports(*phase, a, b); });
      phase_[a][b] = first == chain_.end() ? -1 : static_cast<int>(first - chain_.begin());
      const bool sphere = a == index(ShapeKind::sphere) || b == index(ShapeKind::sphere);
      if (sphere && first != chain_.end()) reads_sphere_poses_ |= (*first)->reads_sphere_poses();
    }
  }
}

void CollisionPipeline::bind_new_shapes() {
  const std::size_t count = shapes_.primitives().size();
  if (count == bound_primitives_) return;
  for (NarrowPhase* phase : chain_) phase->bind(shapes_, bound_primitives_);
  bound_primitives_ = count;
}

bool CollisionPipeline::meet(const CandidatePair& pair, double& reach) const {
  const auto [a, b] = pair;
  const ColliderView view = colliders_.view();
  if (view.body[a] == view.body[b] || (view.movable[a] == 0 && view.movable[b] == 0)) return false;
  if (filter_.is_active() && !filter_.allows(view.body[a], view.body[b])) return false;
  const ColliderMotion one = colliders_.motion(a), two = colliders_.motion(b);
  if (view.kind[a] == ShapeKind::sphere && view.kind[b] == ShapeKind::sphere) {
    reach = reach_of_spheres(one, two, rule_);
    return swept_spheres_meet(one, two, reach, rule_);
  }
  reach = reach_of(one, colliders_.spin(a), two, colliders_.spin(b), rule_);
  if (view.kind[a] == ShapeKind::plane || view.kind[b] == ShapeKind::plane) return true;  // see pair_unbounded()
  return spheres_meet(one, two, reach) && balls_meet(grown_ball(one, rule_), grown_ball(two, rule_)) &&
         overlap(colliders_.swept_box(a, rule_), colliders_.swept_box(b, rule_)) &&
         overlap(expanded(colliders_.tight_box(a), reach), colliders_.tight_box(b));
}

ColliderPair* CollisionPipeline::keep_meeting(std::span<const CandidatePair> batch, ColliderPair* out) const {
  const auto view = colliders_.view();
  const auto velocity = colliders_.velocity();
  for (std::size_t k = 0; k < batch.size(); ++k) {
    if (k + kPrefetch < batch.size()) {
      __builtin_prefetch(&view.ball[batch[k + kPrefetch].b]);
      __builtin_prefetch(&velocity[batch[k + kPrefetch].b]);
    }
    double reach = 0.0;
    if (meet(batch[k], reach)) *out++ = {batch[k].a, batch[k].b, reach};
  }
  return out;
}

void CollisionPipeline::pair_unbounded(ColliderIndex plane, std::size_t first, std::size_t last,
                                       std::vector<CandidatePair>& out) const {
  const ColliderView view = colliders_.view();
  const Pose& pose = view.pose[plane];
  const Vec3 normal = rotate(pose.orientation, {0, 0, 1});
  const ColliderMotion own = colliders_.motion(plane);
  const bool still = own.velocity == Vec3{} && colliders_.spin(plane).spin == Vec3{};
  for (auto other = static_cast<ColliderIndex>(first); other < last; ++other) {
    const ColliderMotion motion = colliders_.motion(other);
    const double height = dot(normal, motion.centre - pose.position);
    if (still) {
      // Most are far away: told without a root, by less than rounding.
      const double beyond = (1.0 - 1e-9) * height - (1.0 + rule_.slack) * motion.radius - rule_.skin;
      if (beyond > 0.0 && beyond * beyond > rule_.dt * rule_.dt * squared_norm(motion.velocity)) continue;
    }
    if (view.movable[other] == 0 && view.movable[plane] == 0) continue;
    if (view.kind[other] == ShapeKind::plane || view.body[other] == view.body[plane]) continue;
    const double reach = reach_of(motion, colliders_.spin(other), own, colliders_.spin(plane), rule_);
    // Written so that a collider with NaN meets nothing.
    if (!(height - motion.radius <= reach)) continue;
    out.push_back({plane, other});
  }
}

void CollisionPipeline::add_unbounded() {
  const auto planes = colliders_.unbounded();
  if (planes.empty()) return;
  const std::size_t chunks = Executor::chunk_count(colliders_.size(), kCandidatesPerChunk);
  if (plane_pairs_.size() < chunks) plane_pairs_.resize(chunks);
  executor_.for_chunks(colliders_.size(), kCandidatesPerChunk, [&](std::size_t first, std::size_t last) {
    std::vector<CandidatePair>& out = plane_pairs_[first / kCandidatesPerChunk];
    out.clear();
    for (const ColliderIndex plane : planes) pair_unbounded(plane, first, last, out);
  });
  for (std::size_t k = 0; k < chunks; ++k) {
    candidates_.insert(candidates_.end(), plane_pairs_[k].begin(), plane_pairs_[k].end());
  }
}

std::span<ColliderPair> CollisionPipeline::keep_chunk(std::size_t first, std::size_t last, std::size_t room) {
  const auto body = colliders_.view().body;
  ColliderPair* const begin = pairs_.data() + room;
  ColliderPair* end = begin;
  const auto keep = [&](std::span<const CandidatePair> batch) {
    end = plain_ ? keep_spheres(batch, end) : keep_meeting(batch, end);
  };
  sorter_.in_order(first, last, std::ref(keep));
  end = std::unique(begin, end, [](const ColliderPair& l, const ColliderPair& r) { return l.a == r.a && l.b == r.b; });
  if (colliders_.one_each()) return {begin, end};
  // Those of several colliders of a body are sorted by the other body.
  for (ColliderPair *own = begin, *next = begin; own < end; own = next) {
    while (next < end && body[next->a] == body[own->a]) ++next;
    if (own->a == next[-1].a) continue;
    std::sort(own, next, [&](const ColliderPair& l, const ColliderPair& r) {
      if (body[l.b] != body[r.b]) return body[l.b] < body[r.b];
      return l.a != r.a ? l.a < r.a : l.b < r.b;
    });
  }
  return {begin, end};
}

/// A plane that does not turn comes as near as its velocity says, as a sphere does.
bool CollisionPipeline::all_plain() const {
  return colliders_.balls_alone() && !filter_.is_active() &&
         std::ranges::all_of(colliders_.unbounded(), [&](auto plane) { return colliders_.spin(plane).spin == Vec3{}; });
}

void CollisionPipeline::find_candidates() {
  candidates_.clear();
  broad_.find_pairs(colliders_.bounded(), executor_, candidates_);
  counts_.candidates = candidates_.size();
  if (large_) {
    broad_.release_workspace();
    if (!colliders_.balls_alone()) colliders_.release_bounded();
  }
  if (colliders_.is_translated()) {
    for (CandidatePair& pair : candidates_) {
      pair = {colliders_.bounded_index(pair.a), colliders_.bounded_index(pair.b)};
    }
  }
  add_unbounded();
  sorter_.sort(candidates_, colliders_.size());
  if (large_) release(candidates_, plane_pairs_);
}

void CollisionPipeline::collide(std::span<const ColliderPair> pairs, ContactBuffer& out) const {
  if (pairs.empty()) return;
  const ColliderView view = colliders_.view();
  constexpr auto kSphere = static_cast<std::size_t>(ShapeKind::sphere),
                 kPlane = static_cast<std::size_t>(ShapeKind::plane);
  const int of_spheres = phase_[kSphere][kSphere];
  if (colliders_.balls_alone() && of_spheres >= 0 && of_spheres == phase_[kSphere][kPlane] &&
      of_spheres == phase_[kPlane][kSphere]) {
    return chain_[static_cast<std::size_t>(of_spheres)]->collide(view, pairs, out);
  }
  const auto kind_of = [&](ColliderIndex i) {
    return view.kind[i] == ShapeKind::cylinder ? index(shapes_.primitives()[view.primitive[i]]) : index(view.kind[i]);
  };
  const auto phase_of = [&](const ColliderPair& pair) { return phase_[kind_of(pair.a)][kind_of(pair.b)]; };
  // Runs of pairs of the same phase, so that contacts stay in the order of pairs.
  for (std::size_t first = 0; first < pairs.size();) {
    const int phase = phase_of(pairs[first]);
    if (phase < 0) throw unsupported(kind_of(pairs[first].a), kind_of(pairs[first].b));
    std::size_t last = first + 1;
    while (last < pairs.size() && phase_of(pairs[last]) == phase) ++last;
    chain_[static_cast<std::size_t>(phase)]->collide(view, pairs.subspan(first, last - first), out);
    first = last;
  }
}

void CollisionPipeline::cut_into_chunks() {
  const auto body = colliders_.view().body;
  chunk_begin_.clear();
  // A body's colliders stay together.
  for (std::size_t i = 0; i < body.size(); i += kCollidersPerChunk) {
    while (i > 0 && i < body.size() && body[i] == body[i - 1]) ++i;
    chunk_begin_.push_back(i);
  }
  chunk_begin_.push_back(body.size());
}

std::span<const Contact> CollisionPipeline::find_contacts(std::size_t expected) {
  plain_ = all_plain();
  cut_into_chunks();
  const std::size_t chunks = chunk_begin_.size() - 1;
  std::span<const Contact> found;
  if (executor_.threads() == 1) {
    // The pairs of a chunk go where those before were, so that they and their spheres stay in the cache.
    std::size_t most = 0;
    for (std::size_t k = 0; k < chunks; ++k) {
      most = std::max(most, sorter_.begin(chunk_begin_[k + 1]) - sorter_.begin(chunk_begin_[k]));
    }
    resize_kept(most, pairs_);
    // Contacts live through the whole step: their memory is kept.
    contacts_.clear();
    const std::size_t room = colliders_.balls_alone() ? sorter_.size() : std::min(sorter_.size(), expected);
    if (contacts_.capacity() < room) make_room(room + room / 16, contacts_);
    for (std::size_t k = 0; k < chunks; ++k) {
      const std::span<const ColliderPair> pairs = keep_chunk(chunk_begin_[k], chunk_begin_[k + 1], 0);
      counts_.pairs += pairs.size();
      collide(pairs, contacts_);
    }
    found = contacts_;
  } else {
    resize_kept(sorter_.size(), pairs_);
    if (chunk_contacts_.size() < chunks) chunk_contacts_.resize(chunks);
    chunk_pairs_.resize(chunks);
    executor_.for_chunks(chunks, 1, [&](std::size_t chunk, std::size_t) {
      const std::size_t first = chunk_begin_[chunk];
      const std::span<const ColliderPair> pairs = keep_chunk(first, chunk_begin_[chunk + 1], sorter_.begin(first));
      chunk_pairs_[chunk] = pairs.size();
      chunk_contacts_[chunk].clear();
      chunk_contacts_[chunk].reserve(pairs.size());
      collide(pairs, chunk_contacts_[chunk]);
    });
    for (std::size_t k = 0; k < chunks; ++k) counts_.pairs += chunk_pairs_[k];
    found = join_contacts(chunks);
  }
  if (large_) {
    release(chunk_contacts_);
    // What spheres need is small beside the rest of a step, and kept.
    if (!colliders_.balls_alone()) {
      sorter_.release_buffers();
      release(pairs_);
      colliders_.release_step();
    }
  }
  counts_.contacts = found.size();
  return found;
}

std::span<const Contact> CollisionPipeline::join_contacts(std::size_t chunks) {
  chunk_offset_.resize(chunks + 1);
  chunk_offset_[0] = 0;
  for (std::size_t k = 0; k < chunks; ++k) chunk_offset_[k + 1] = chunk_offset_[k] + chunk_contacts_[k].size();
  resize_kept(chunk_offset_[chunks], joined_contacts_);
  executor_.for_chunks(chunks, 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      std::copy(chunk_contacts_[k].begin(), chunk_contacts_[k].end(),
                joined_contacts_.begin() + static_cast<std::ptrdiff_t>(chunk_offset_[k]));
    }
  });
  return joined_contacts_;
}

void CollisionPipeline::place_colliders(const BodyView& bodies, std::span<const Vec3> velocity,
                                        std::span<const Vec3> angular_velocity) {
  bind_new_shapes();
  if (filter_.is_active()) filter_.look_up(bodies);
  const ColliderUse use{.boxes = !broad_.takes_balls_alone(), .sphere_poses = reads_sphere_poses_};
  colliders_.build(shapes_, bodies, velocity, angular_velocity, rule_, use, executor_);
}

std::span<const Contact> CollisionPipeline::find(const BodyView& bodies, std::span<const Vec3> velocity,
                                                 std::span<const Vec3> angular_velocity, double dt) {
  large_ = bodies.size() >= kManyBodies;
  rule_ = {.dt = dt, .slack = settings_.reach_slack};
  place_colliders(bodies, velocity, angular_velocity);
  // Room for so many contacts, where candidates tell nothing.
  const std::size_t expected = counts_.contacts + counts_.contacts / 8;
  counts_ = {colliders_.size(), 0, 0, 0};
  find_candidates();
  return find_contacts(expected);
}

}  // namespace scree
