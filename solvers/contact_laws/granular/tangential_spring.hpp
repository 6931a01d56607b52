// TangentialSpring: the incrementing spring of Cundall and Strack (Geotechnique 29 (1979) 47), with a dashpot and Coulomb's
// limit:
//
//     S' = kt vt,      Ft = -(S + Ct vt),      |S + Ct vt| <= mu load
//
// S, the force of the spring [N], is what a contact keeps. As the contact turns, S is laid into the new tangent plane with its
// length kept. Where a contact slides, S is what the dashpot leaves of Coulomb's limit, so that both together stand at it.
//
// Kept is the force and not the displacement, so that a stiffness that changes (Mindlin's) needs no second rule: the force
// grows by kt vt dt with the stiffness of the moment.
#pragma once

#include <cstddef>

#include "granular/contact_lanes.hpp"

namespace scree::granular {

/// Doubles that a contact keeps, from ContactBatch::history[0] on.
inline constexpr std::size_t kTangentialHistory = 3;

/// Fills in batch.force from lanes.normal and the spring, and moves the springs on.
/// @param friction Coulomb's coefficient [1].
/// @param rescale factor on the kept spring before it moves on [1], or null.
void add_tangential_spring(ContactBatch& batch, const ContactLanes& lanes, const Lane& friction,
                           const Lane* rescale = nullptr);

}  // namespace scree::granular
