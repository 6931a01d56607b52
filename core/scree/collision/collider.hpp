// Colliders: the primitives of all bodies, placed in the world for one step.
#pragma once

#include <cstdint>
#include <span>

#include "scree/math/aabb.hpp"
#include "scree/model/body.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// Index of a collider in a ColliderView.
using ColliderIndex = std::uint32_t;

/// The smallest ball about a collider's origin that holds it; of a sphere the sphere itself.
struct BoundingBall {
  Vec3 centre;          ///< [m], world
  double radius = 0.0;  ///< [m]; infinite for a plane
};

/// Spans of equal length, one entry per colliding primitive per body, in order
/// of body, then primitive.
struct ColliderView {
  std::span<const std::uint64_t> key;        ///< stable: the same primitive of the same body has it in every step
  std::span<const BodyIndex> body;           ///< index into the BodyView
  std::span<const std::uint32_t> primitive;  ///< index into ShapeSet::primitives()
  std::span<const std::uint32_t> ordinal;    ///< of the primitive within its shape, as Contact::primitive_a counts
  std::span<const Pose> pose;          ///< of the primitive's frame in the world [m]; of a sphere it holds nothing
                                       ///< unless a phase asks for it, see NarrowPhase::reads_sphere_poses()
  std::span<const char> movable;       ///< 1 for primitives of dynamic bodies
  std::span<const ShapeKind> kind;     ///< of the primitive
  std::span<const BoundingBall> ball;  ///< of the primitive

  [[nodiscard]] std::size_t size() const { return key.size(); }
};

/// Two colliders whose contacts are wanted, a < b.
struct ColliderPair {
  ColliderIndex a = 0;
  ColliderIndex b = 0;
  double reach = 0.0;  ///< contacts with a gap below this are wanted [m]

  bool operator==(const ColliderPair&) const = default;
};

/// Candidates of a broad phase: a pair of indices, in any order.
struct CandidatePair {
  ColliderIndex a = 0;
  ColliderIndex b = 0;
};

/// Two bodies, a < b.
struct BodyPair {
  BodyIndex a = 0;
  BodyIndex b = 0;

  bool operator==(const BodyPair&) const = default;
};

/// What a stepper expects of bodies as long as it uses a list of neighbours: at any time t after the list was made no point of a
/// body is farther than half of the skin from where it would be if the body had moved by velocity times min(t, horizon),
/// without turning.
struct ExpectedMotion {
  std::span<const Vec3> velocity;  ///< by body [m/s], world
  double horizon = 0.0;            ///< [s]
  double skin = 0.0;               ///< [m]
};

/// Who may touch whom before anything has moved far; see StepServices::neighbours().
struct NeighbourView {
  std::span<const BodyPair> balls;  ///< is_ball() with another or with what is_flat(); sorted
  /// The bodies of all other pairs, in order, whose poses neighbour_contacts() reads; empty when there are no such pairs.
  std::span<const BodyIndex> others;
};

}  // namespace scree
