// CollisionPipeline: from bodies to contacts, whatever phases the scene chose.
//
// One call a step: place colliders, ask the broad phase for candidates, drop
// those that cannot meet within the step, sort, and hand the rest to the chain
// of narrow phases. The result does not depend on the broad phase or on the
// number of threads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scree/collision/collider_set.hpp"
#include "scree/collision/collision_filter.hpp"
#include "scree/collision/contact.hpp"
#include "scree/collision/pair_sorter.hpp"
#include "scree/collision/part_of_scene.hpp"
#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/narrow_phase.hpp"

namespace scree {

class Executor;

/// What the last step of a CollisionPipeline went through.
struct CollisionCounts {
  std::size_t colliders = 0;
  std::size_t candidates = 0;  ///< pairs that the broad phase reported
  std::size_t pairs = 0;       ///< pairs given to narrow phases
  std::size_t contacts = 0;
};

/// Settings of the pipeline.
struct CollisionSettings {
  /// Contacts are sought this much beyond what motion needs, in bounding radii
  /// of the smaller collider [1]; keeps resting contacts from flickering.
  double reach_slack = 1e-3;
};

/// Finds all contacts of a step. Shapes, phases and executor outlive it.
class CollisionPipeline {
 public:
  /// Each pair of kinds goes to the first phase of `chain` that supports it.
  CollisionPipeline(const ShapeSet& shapes, BroadPhase& broad, std::vector<NarrowPhase*> chain,
                    const Executor& executor, const CollisionSettings& settings = {});

  /// Contacts with a gap below what the pair can close within `dt` [s] at these
  /// velocities [m/s] and angular velocities [rad/s] (one per body, world).
  /// Sorted by (body a, body b, primitive a, primitive b, feature), the same
  /// bits for any number of threads. Valid until the next call.
  /// @throws Error (usage) when two kinds meet that no phase supports.
  std::span<const Contact> find(const BodyView& bodies, std::span<const Vec3> velocity,
                                std::span<const Vec3> angular_velocity, double dt);

  /// Contacts, as find() has them, of a `few` bodies that forces move, in increasing order, with those that forces do not move.
  /// What find() gave stays valid. Cost: the few times all walls. Valid until the next call of this.
  std::span<const Contact> find_walls(const BodyView& bodies, std::span<const BodyIndex> few,
                                      std::span<const Vec3> velocity, std::span<const Vec3> angular_velocity,
                                      double dt);

  /// Pairs that can touch as long as bodies move as expected. Valid until the next call of find() or this.
  NeighbourView find_neighbours(const BodyView& bodies, const ExpectedMotion& expected);
  /// Contacts with a gap below `reach` [m] of those neighbours that are not simple pairs, at the present poses of the same bodies;
  /// sorted as those of find(), and valid as long.
  std::span<const Contact> collide_neighbours(const BodyView& bodies, double reach);

  /// Who meets whom; to be set between steps.
  [[nodiscard]] CollisionFilter& filter() { return filter_; }
  [[nodiscard]] const CollisionFilter& filter() const { return filter_; }

  /// Checks that every two kinds of which one may move, in groups that meet, are supported.
  /// @throws Error (usage) naming the two kinds.
  void check_support(const BodyView& bodies) const;

  [[nodiscard]] const CollisionCounts& counts() const { return counts_; }

 private:
  void bind_new_shapes();
  /// Appends those of sorted candidates that can meet within the step to `out`, which has room for all, and returns its end.
  ColliderPair* keep_meeting(std::span<const CandidatePair> batch, ColliderPair* out) const;
  /// The same where plain_.
  ColliderPair* keep_spheres(std::span<const CandidatePair> batch, ColliderPair* out) const;
  bool meet(const CandidatePair& pair, double& reach) const;
  void pair_unbounded(ColliderIndex plane, std::size_t first, std::size_t last, std::vector<CandidatePair>& out) const;
  void add_unbounded();
  void find_candidates();
  [[nodiscard]] bool all_plain() const;
  void cut_into_chunks();
  /// The pairs of the colliders first..last-1, sorted; they lie in pairs_, from `room` on.
  std::span<ColliderPair> keep_chunk(std::size_t first, std::size_t last, std::size_t room);
  void place_colliders(const BodyView& bodies, std::span<const Vec3> velocity, std::span<const Vec3> angular_velocity);
  struct NeighbourChunk;
  void part_neighbours(const BodyView& bodies, std::span<const ColliderPair> pairs, std::size_t room,
                       NeighbourChunk& out);
  void drop_distant_neighbours();
  void look_at_neighbours();
  void collide(std::span<const ColliderPair> pairs, ContactBuffer& out) const;
  std::span<const Contact> find_contacts(std::size_t expected);
  std::span<const Contact> join_contacts(std::size_t chunks);

  const ShapeSet& shapes_;
  BroadPhase& broad_;
  std::vector<NarrowPhase*> chain_;
  const Executor& executor_;
  CollisionSettings settings_;
  /// Phase of the chain for two kinds, or -1; the last kind is that of hollow cylinders.
  std::array<std::array<int, kShapeKindCount + 1>, kShapeKindCount + 1> phase_{};
  std::size_t bound_primitives_ = 0;
  bool reads_sphere_poses_ = false;

  CollisionFilter filter_;
  ReachRule rule_;
  ColliderSet colliders_;
  std::vector<CandidatePair> candidates_;
  std::vector<std::vector<CandidatePair>> plane_pairs_;  // by chunk of colliders
  PairSorter sorter_;
  std::vector<std::size_t> chunk_begin_;     // colliders, and one more
  UninitialisedVector<ColliderPair> pairs_;  // of a chunk; with several threads of all, with gaps between the chunks
  std::vector<std::size_t> chunk_pairs_;     // how many
  std::vector<ContactBuffer> chunk_contacts_;
  std::vector<std::size_t> chunk_offset_;
  ContactBuffer contacts_;                        // of one thread
  UninitialisedVector<Contact> joined_contacts_;  // of several
  CollisionCounts counts_;

  PartOfScene part_;
  std::vector<ColliderPair> wall_pairs_;
  ContactBuffer wall_contacts_;

  /// What find_neighbours() makes of a chunk of colliders.
  struct NeighbourChunk {
    std::size_t pairs = 0, balls = 0;
    std::vector<ColliderPair> others;
  };
  std::vector<NeighbourChunk> chunk_neighbours_;
  UninitialisedVector<BodyPair> ball_neighbours_;
  std::vector<Vec3> no_spin_;  // by body
  std::vector<ColliderPair> other_neighbours_;
  std::vector<ColliderIndex> followed_;     // the colliders of those
  std::vector<BodyIndex> followed_bodies_;  // and their bodies
  bool plain_ = false;                      ///< all are spheres, or planes that do not turn, and may meet all
  bool large_ = false;                      ///< buffers are freed as soon as nobody reads them any more
};

}  // namespace scree
