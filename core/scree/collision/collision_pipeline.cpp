#include "scree/collision/collision_pipeline.hpp"

#include <algorithm>
#include <string>

#include "scree/base/error.hpp"
#include "scree/base/release.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kCandidatesPerChunk = 8192;
constexpr std::size_t kPairsPerChunk = 1024;

std::size_t index(ShapeKind kind) { return static_cast<std::size_t>(kind); }

/// Narrow phases tell one more kind apart than there are: a hollow cylinder is not a cylinder.
constexpr std::size_t kHollow = kShapeKindCount;
constexpr std::size_t kKinds = kShapeKindCount + 1;

std::size_t index(const Primitive& primitive) { return primitive.hollow ? kHollow : index(primitive.kind); }

const char* name_of(std::size_t kind) {
  return kind == kHollow ? "hollow cylinder" : to_string(static_cast<ShapeKind>(kind));
}

bool supports(const NarrowPhase& phase, std::size_t a, std::size_t b) {
  if (a == kHollow && b == kHollow) return false;
  if (a == kHollow) return phase.supports_hollow(static_cast<ShapeKind>(b));
  if (b == kHollow) return phase.supports_hollow(static_cast<ShapeKind>(a));
  return phase.supports(static_cast<ShapeKind>(a), static_cast<ShapeKind>(b));
}

Error unsupported(std::size_t a, std::size_t b) {
  return Error{ErrorKind::usage, std::string{"no narrow phase of the scene computes contacts of "} + name_of(a) +
                                     " against " + name_of(b) +
                                     "; add one that does to its list of narrow phases, or give one of them "
                                     "collides = false."};
}

/// Candidates ahead of the present one whose records are fetched into the cache.
constexpr std::size_t kPrefetch = 16;

/// True when the bounding spheres come within `reach` of each other.
bool spheres_meet(const ColliderMotion& a, const ColliderMotion& b, double reach) {
  const double radii = a.radius + b.radius + reach;
  return squared_norm(b.centre - a.centre) <= radii * radii;
}

/// Which bodies have a kind of primitive: none, one or several.
struct Holders {
  std::size_t first = 0;
  int count = 0;  // of different bodies, up to two

  void add(std::size_t body) {
    if (count == 0) first = body;
    if (count == 0 || (count == 1 && body != first)) ++count;
  }
};

/// True when a body of `a` and another one of `b` exist.
bool can_differ(const Holders& a, const Holders& b) {
  return a.count > 0 && b.count > 0 && (a.count > 1 || b.count > 1 || a.first != b.first);
}

}  // namespace

CollisionPipeline::CollisionPipeline(const ShapeSet& shapes, BroadPhase& broad, std::vector<NarrowPhase*> chain,
                                     const Executor& executor, const CollisionSettings& settings)
    : shapes_{shapes}, broad_{broad}, chain_{std::move(chain)}, executor_{executor}, settings_{settings} {
  for (std::size_t a = 0; a < kKinds; ++a) {
    for (std::size_t b = 0; b < kKinds; ++b) {
      const auto first =
          std::find_if(chain_.begin(), chain_.end(), [&](const NarrowPhase* phase) { return supports(*phase, a, b); });
      phase_[a][b] = first == chain_.end() ? -1 : static_cast<int>(first - chain_.begin());
    }
  }
}

void CollisionPipeline::bind_new_shapes() {
  const std::size_t count = shapes_.primitives().size();
  if (count == bound_primitives_) return;
  for (NarrowPhase* phase : chain_) phase->bind(shapes_, bound_primitives_);
  bound_primitives_ = count;
}

void CollisionPipeline::check_support(const BodyView& bodies) const {
  // By kind and by group; without groups all bodies are in the first one.
  using ByGroup = std::array<Holders, CollisionFilter::kMostGroups>;
  std::array<ByGroup, kKinds> present{};
  std::array<ByGroup, kKinds> moving{};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const Primitive& primitive : shapes_.primitives(shapes_.shapes()[bodies.shape[i]])) {
      if (!primitive.collides) continue;
      const CollisionGroup group = bodies.collision_group.empty() ? CollisionGroup{0} : bodies.collision_group[i];
      present[index(primitive)][group].add(i);
      if (bodies.motion[i] == Motion::dynamic) moving[index(primitive)][group].add(i);
    }
  }
  const auto can_meet = [&](std::size_t a, std::size_t b) {
    for (CollisionGroup g = 0; g < CollisionFilter::kMostGroups; ++g) {
      for (CollisionGroup h = 0; moving[a][g].count > 0 && h < CollisionFilter::kMostGroups; ++h) {
        if (filter_.groups_meet(g, h) && can_differ(moving[a][g], present[b][h])) return true;
      }
    }
    return false;
  };
  for (std::size_t a = 0; a < kKinds; ++a) {
    for (std::size_t b = 0; b < kKinds; ++b) {
      // Planes never meet planes: both are half spaces without an edge.
      const bool planes = a == index(ShapeKind::plane) && b == index(ShapeKind::plane);
      if (phase_[a][b] < 0 && !planes && can_meet(a, b)) throw unsupported(a, b);
    }
  }
}

void CollisionPipeline::keep_meeting(std::size_t first, std::size_t last, std::vector<ColliderPair>& out) const {
  const auto motion = colliders_.motion();
  const auto box = colliders_.view().box;
  const bool filtered = filter_.is_active();
  for (std::size_t k = first; k < last; ++k) {
    if (k + kPrefetch < last) {
      __builtin_prefetch(&motion[colliders_.bounded_index(candidates_[k + kPrefetch].a)]);
      __builtin_prefetch(&motion[colliders_.bounded_index(candidates_[k + kPrefetch].b)]);
    }
    const ColliderIndex one = colliders_.bounded_index(candidates_[k].a);
    const ColliderIndex two = colliders_.bounded_index(candidates_[k].b);
    const ColliderIndex a = std::min(one, two);
    const ColliderIndex b = std::max(one, two);
    const ColliderMotion& ma = motion[a];
    const ColliderMotion& mb = motion[b];
    if (ma.body == mb.body || (!ma.movable && !mb.movable)) continue;
    if (filtered && !filter_.allows(ma.body, mb.body)) continue;
    // Boxes of spheres are cheaper to compute than to read.
    if (ma.kind == ShapeKind::sphere && mb.kind == ShapeKind::sphere) {
      const double reach = reach_of_spheres(ma, mb, rule_);
      // Of spheres that overlap, by more than rounding, the boxes do.
      const double touching = (1.0 - 1e-9) * (ma.radius + mb.radius);
      if (squared_norm(mb.centre - ma.centre) <= touching * touching) {
        out.push_back({a, b, reach});
        continue;
      }
      if (!spheres_meet(ma, mb, reach)) continue;
      if (overlap(swept_sphere(ma, rule_), swept_sphere(mb, rule_))) out.push_back({a, b, reach});
    } else {
      const double reach = reach_of(ma, colliders_.spin(a), mb, colliders_.spin(b), rule_);
      if (!spheres_meet(ma, mb, reach) || !balls_meet(grown_ball(ma, rule_), grown_ball(mb, rule_))) continue;
      if (!overlap(box[a], box[b])) continue;
      if (overlap(expanded(colliders_.tight_box(a), reach), colliders_.tight_box(b))) out.push_back({a, b, reach});
    }
  }
}

void CollisionPipeline::pair_unbounded(ColliderIndex plane, std::size_t first, std::size_t last,
                                       std::vector<ColliderPair>& out) const {
  const ColliderView view = colliders_.view();
  const auto motion = colliders_.motion();
  const Pose& pose = view.pose[plane];
  const Vec3 normal = rotate(pose.orientation, {0, 0, 1});
  const bool filtered = filter_.is_active();
  for (auto other = static_cast<ColliderIndex>(first); other < last; ++other) {
    if (!motion[other].movable && !motion[plane].movable) continue;
    if (motion[other].kind == ShapeKind::plane || motion[other].body == motion[plane].body) continue;
    if (filtered && !filter_.allows(motion[other].body, motion[plane].body)) continue;
    const double reach = reach_of(motion[other], colliders_.spin(other), motion[plane], colliders_.spin(plane), rule_);
    const double height = dot(normal, motion[other].centre - pose.position);
    // Written so that a collider with NaN meets nothing.
    if (!(height - motion[other].radius <= reach)) continue;
    out.push_back({std::min(plane, other), std::max(plane, other), reach});
  }
}

void CollisionPipeline::find_pairs(std::size_t body_count) {
  candidates_.clear();
  broad_.find_pairs(colliders_.bounded(), executor_, candidates_);
  counts_.candidates = candidates_.size();
  if (large_) {
    broad_.release_workspace();
    colliders_.release_bounded();
  }

  const std::size_t chunks = Executor::chunk_count(candidates_.size(), kCandidatesPerChunk);
  const auto planes = colliders_.unbounded();
  const std::size_t plane_chunks = Executor::chunk_count(colliders_.size(), kCandidatesPerChunk);
  const std::size_t parts = chunks + planes.size() * plane_chunks;
  if (chunk_pairs_.size() < parts) chunk_pairs_.resize(parts);
  executor_.for_chunks(parts, 1, [&](std::size_t part, std::size_t) {
    std::vector<ColliderPair>& out = chunk_pairs_[part];
    out.clear();
    if (part >= chunks) {
      const std::size_t begin = (part - chunks) % plane_chunks * kCandidatesPerChunk;
      const std::size_t end = std::min(colliders_.size(), begin + kCandidatesPerChunk);
      return pair_unbounded(planes[(part - chunks) / plane_chunks], begin, end, out);
    }
    const std::size_t first = part * kCandidatesPerChunk;
    const std::size_t last = std::min(candidates_.size(), first + kCandidatesPerChunk);
    if (large_) out.reserve(last - first);
    keep_meeting(first, last, out);
  });
  if (large_) release(candidates_);
  pairs_ = sorter_.sort(std::span{chunk_pairs_}.first(parts), colliders_.view().body, body_count, executor_);
  if (large_) release(chunk_pairs_);
  counts_.pairs = pairs_.size();
}

void CollisionPipeline::collide(std::span<const ColliderPair> pairs, ContactBuffer& out) const {
  const ColliderView view = colliders_.view();
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

std::span<const Contact> CollisionPipeline::find_contacts() {
  std::span<const Contact> found;
  if (executor_.threads() == 1) {
    contacts_.clear();
    // Most pairs have one contact.
    contacts_.reserve(pairs_.size());
    collide(pairs_, contacts_);
    found = contacts_;
  } else {
    const std::size_t chunks = Executor::chunk_count(pairs_.size(), kPairsPerChunk);
    if (chunk_contacts_.size() < chunks) chunk_contacts_.resize(chunks);
    executor_.for_chunks(chunks, 1, [&](std::size_t chunk, std::size_t) {
      chunk_contacts_[chunk].clear();
      const std::size_t first = chunk * kPairsPerChunk;
      const std::size_t pairs = std::min(kPairsPerChunk, pairs_.size() - first);
      chunk_contacts_[chunk].reserve(pairs);
      collide(pairs_.subspan(first, pairs), chunk_contacts_[chunk]);
    });
    found = join_contacts(chunks);
  }
  if (large_) {
    pairs_ = {};
    sorter_.release_buffers();
    colliders_.release_step();
    release(chunk_contacts_);
  }
  counts_.contacts = found.size();
  return found;
}

std::span<const Contact> CollisionPipeline::join_contacts(std::size_t chunks) {
  chunk_offset_.resize(chunks + 1);
  chunk_offset_[0] = 0;
  for (std::size_t k = 0; k < chunks; ++k) chunk_offset_[k + 1] = chunk_offset_[k] + chunk_contacts_[k].size();
  joined_contacts_.resize(chunk_offset_[chunks]);
  executor_.for_chunks(chunks, 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      std::copy(chunk_contacts_[k].begin(), chunk_contacts_[k].end(),
                joined_contacts_.begin() + static_cast<std::ptrdiff_t>(chunk_offset_[k]));
    }
  });
  return joined_contacts_;
}

std::span<const Contact> CollisionPipeline::find(const BodyView& bodies, std::span<const Vec3> velocity,
                                                 std::span<const Vec3> angular_velocity, double dt) {
  bind_new_shapes();
  large_ = bodies.size() >= kManyRecords;
  if (large_) release(contacts_, joined_contacts_);
  rule_ = {dt, settings_.reach_slack};
  if (filter_.is_active()) filter_.look_up(bodies);
  colliders_.build(shapes_, bodies, velocity, angular_velocity, rule_, executor_);
  counts_ = {colliders_.size(), 0, 0, 0};
  find_pairs(bodies.size());
  return find_contacts();
}

}  // namespace scree
