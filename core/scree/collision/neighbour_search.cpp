// The part of CollisionPipeline that serves steppers with steps far shorter than the time in which neighbours change: pairs are
// found once, and looked at again and again while the bodies move.
#include <algorithm>

#include "scree/base/release.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/collision/simple_pairs.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kPairsPerChunk = 256;

}  // namespace

NeighbourView CollisionPipeline::find_neighbours(const BodyView& bodies, const ExpectedMotion& expected) {
  large_ = false;                                           // what is found stays in use
  rule_ = {.dt = expected.horizon, .skin = expected.skin};  // slack is for contacts that flicker
  no_spin_.assign(bodies.size(), Vec3{});
  place_colliders(bodies, expected.velocity, no_spin_);
  counts_ = {colliders_.size(), 0, 0, 0};
  find_candidates();
  plain_ = all_plain();
  cut_into_chunks();
  const std::size_t chunks = chunk_begin_.size() - 1;
  resize_kept(sorter_.size(), pairs_, ball_neighbours_);
  chunk_neighbours_.resize(chunks);
  executor_.for_chunks(chunks, 1, [&](std::size_t k, std::size_t) {
    const std::size_t first = chunk_begin_[k], room = sorter_.begin(first);
    part_neighbours(bodies, keep_chunk(first, chunk_begin_[k + 1], room), room, chunk_neighbours_[k]);
  });
  std::size_t balls = 0;
  other_neighbours_.clear();
  for (std::size_t k = 0; k < chunks; ++k) {
    const NeighbourChunk& of = chunk_neighbours_[k];
    const auto room = ball_neighbours_.begin() + static_cast<std::ptrdiff_t>(sorter_.begin(chunk_begin_[k]));
    std::copy_n(room, of.balls, ball_neighbours_.begin() + static_cast<std::ptrdiff_t>(balls));
    balls += of.balls;
    other_neighbours_.insert(other_neighbours_.end(), of.others.begin(), of.others.end());
    counts_.pairs += of.pairs;
  }
  ball_neighbours_.resize(balls);
  drop_distant_neighbours();
  return {ball_neighbours_, followed_bodies_};
}

/// Puts pairs of two balls, or of a ball near a flat, into ball_neighbours_ from `room` on, and all other pairs into `out`.
void CollisionPipeline::part_neighbours(const BodyView& bodies, std::span<const ColliderPair> pairs, std::size_t room,
                                        NeighbourChunk& out) {
  out.pairs = pairs.size();
  out.balls = 0;
  out.others.clear();
  const auto body = colliders_.view().body;
  const auto near = [&](BodyIndex ball, BodyIndex flat, double reach) {
    const Pose wall = {bodies.position[flat], bodies.orientation[flat]};
    const Pose plane = wall * only_primitive(shapes_, bodies.shape[flat])->local;
    const double radius = only_primitive(shapes_, bodies.shape[ball])->size.x;
    return transform_back(plane, bodies.position[ball]).z - radius < reach;
  };
  for (const ColliderPair& pair : pairs) {
    const BodyIndex a = body[pair.a], b = body[pair.b];
    const bool ball_a = colliders_.is_ball(bodies.shape[a]), ball_b = colliders_.is_ball(bodies.shape[b]);
    const bool simple = ball_a && ball_b;
    if (!simple && !(ball_a && is_flat(shapes_, bodies, b)) && !(ball_b && is_flat(shapes_, bodies, a))) {
      out.others.push_back(pair);
    } else if (simple || near(ball_a ? a : b, ball_a ? b : a, pair.reach)) {
      ball_neighbours_[room + out.balls++] = {a, b};
    }
  }
}

/// A grain within the box of a large mesh need not be near its surface: pairs without a contact within their reach are left out
/// until the next search.
void CollisionPipeline::drop_distant_neighbours() {
  look_at_neighbours();
  const ColliderView view = colliders_.view();
  const auto is_of = [&](const Contact& c, const ColliderPair& pair) {
    return c.a == view.body[pair.a] && c.b == view.body[pair.b] && c.primitive_a == view.ordinal[pair.a] &&
           c.primitive_b == view.ordinal[pair.b];
  };
  std::size_t kept = 0;
  for (std::size_t first = 0; first < other_neighbours_.size(); first += kPairsPerChunk) {
    const ContactBuffer& contacts = chunk_contacts_[first / kPairsPerChunk];
    std::size_t next = 0;
    for (std::size_t k = first; k < std::min(first + kPairsPerChunk, other_neighbours_.size()); ++k) {
      const ColliderPair pair = other_neighbours_[k];
      if (next == contacts.size() || !is_of(contacts[next], pair)) continue;
      while (next < contacts.size() && is_of(contacts[next], pair)) ++next;
      other_neighbours_[kept++] = pair;
    }
  }
  other_neighbours_.resize(kept);
  followed_.clear();
  for (const ColliderPair& pair : other_neighbours_) followed_.insert(followed_.end(), {pair.a, pair.b});
  std::ranges::sort(followed_);
  followed_.erase(std::unique(followed_.begin(), followed_.end()), followed_.end());
  followed_bodies_.clear();
  for (const ColliderIndex k : followed_) {
    // Colliders are in order of bodies.
    if (followed_bodies_.empty() || followed_bodies_.back() != view.body[k]) followed_bodies_.push_back(view.body[k]);
  }
}

/// The contacts of other_neighbours_, chunk by chunk of kPairsPerChunk.
void CollisionPipeline::look_at_neighbours() {
  const std::size_t chunks = Executor::chunk_count(other_neighbours_.size(), kPairsPerChunk);
  if (chunk_contacts_.size() < chunks) chunk_contacts_.resize(chunks);
  executor_.for_chunks(other_neighbours_.size(), kPairsPerChunk, [&](std::size_t first, std::size_t last) {
    ContactBuffer& out = chunk_contacts_[first / kPairsPerChunk];
    out.clear();
    collide(std::span<const ColliderPair>{other_neighbours_}.subspan(first, last - first), out);
  });
}

std::span<const Contact> CollisionPipeline::collide_neighbours(const BodyView& bodies, double reach) {
  for (ColliderPair& pair : other_neighbours_) pair.reach = reach;
  colliders_.follow(shapes_, bodies, followed_, executor_);
  look_at_neighbours();
  const std::span<const Contact> found = join_contacts(Executor::chunk_count(other_neighbours_.size(), kPairsPerChunk));
  counts_.contacts = found.size();
  return found;
}

}  // namespace scree
