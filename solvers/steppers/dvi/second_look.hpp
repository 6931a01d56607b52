// SecondLook: walls that nobody looked for, because what is about to meet them was struck in this very step.
//
// Contacts are sought as far as bodies come at their free velocities. A grain at rest that a fast one strikes has its
// velocity from the solve alone, and may be past a thin plate at the end of the step. So where impulses move a body by more
// than half its radius, its contacts with bodies that forces do not move are sought once more at the velocities that they
// give, and those that it would cross join the problem. Slow grains pay a comparison each.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/twist.hpp"
#include "scree/collision/contact.hpp"

namespace scree::dvi {

/// Velocities of all bodies, world.
struct Velocities {
  std::span<const Vec3> linear;   ///< [m/s]
  std::span<const Vec3> angular;  ///< [rad/s]
};

/// Leaves in `struck`, in increasing order, those of the bodies `numbers` that forces move, and that their changes `w` move by
/// more than half their radius in `dt` [s].
void find_struck(const BodyView& bodies, std::span<const BodyIndex> numbers, std::span<const Twist> w, double dt,
                 std::vector<BodyIndex>& struck);

/// Puts those of the contacts `found` at the velocities `after` into `contacts` that are not there, have one body that forces
/// do not move, and would be crossed by more than a quarter of the other's radius within `dt` [s]; both lists are in the
/// order of CollisionPipeline. False when there are none.
[[nodiscard]] bool add_crossed(const BodyView& bodies, std::span<const Contact> found, const Velocities& after,
                               double dt, std::vector<Contact>& contacts);

}  // namespace scree::dvi
