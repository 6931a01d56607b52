// NarrowPhase: from pairs of primitives to contact points.
#pragma once

#include <cstdint>
#include <span>

#include "scree/collision/collider.hpp"
#include "scree/collision/contact.hpp"
#include "scree/interfaces/plugin.hpp"

namespace scree {

/// Computes contacts. Several narrow phases chain: each pair of kinds goes to
/// the first that supports it.
class NarrowPhase : public Plugin {
 public:
  static constexpr const char* kKind = "narrow_phase";
  ~NarrowPhase() override;

  /// True when pairs of these kinds can be given to collide(), in either order.
  [[nodiscard]] virtual bool supports(ShapeKind a, ShapeKind b) const = 0;
  /// The same for a hollow cylinder, a drum seen from inside, and what lies in it; supports() speaks of solid cylinders.
  [[nodiscard]] virtual bool supports_hollow([[maybe_unused]] ShapeKind inside) const { return false; }
  /// False for a phase that takes a sphere's place from ColliderView::ball: in a scene of spheres poses need not be written.
  [[nodiscard]] virtual bool reads_sphere_poses() const { return true; }
  /// Called after setup and whenever shapes were added: primitives from
  /// `first_new` on are new. `shapes` outlives this.
  virtual void bind(const ShapeSet& shapes, std::size_t first_new_primitive);

  /// Appends the contacts of `pairs` with gap < pair.reach, pair after pair,
  /// with body a of the contact = body of collider a, normal from a to b, and,
  /// within one pair, in increasing order of `feature`. No manifold is kept
  /// between steps. Called from several threads at once with different pairs
  /// and buffers.
  virtual void collide(const ColliderView& colliders, std::span<const ColliderPair> pairs,
                       ContactBuffer& out) const = 0;

  /// Pairs, since this was made, whose first answer did not hold its own checks, so that the fallback which the phase
  /// states in its description answered instead. Counted for the summary of a run. Zero for phases that cannot fail.
  [[nodiscard]] virtual std::uint64_t fallbacks() const { return 0; }
};

}  // namespace scree
