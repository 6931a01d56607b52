// The contact of two adhesive elastic spheres: Johnson, Kendall, Roberts, Proc. R. Soc. London A 324 (1971) 301.
//
//     F = 4 E a^3 / (3 R) - sqrt(8 pi w E a^3),     x = a^2 / R - sqrt(2 pi w a / E)
//
// a radius of the contact [m], x overlap [m], R effective radius [m], E effective modulus [Pa], w work of adhesion [J/m2].
// In units of c = (pi w R^2 / (8 E))^(1/3), the radius at which the neck breaks when the bodies are drawn apart, and with
// a = c s^2:
//
//     F = (pi w R / 2) (s^6 / 3 - 2 s^3),           x = (c^2 / R) (s^4 - 4 s),      s >= 1
//
// Least force -3/2 pi w R at s^3 = 3; the neck breaks at s = 1, x = -3 c^2 / R. Surfaces that come together jump into contact at
// x = 0, where F = -4/3 pi w R.
#pragma once

#include "granular/contact_lanes.hpp"

namespace scree::granular {

/// c [m] of the text above.
[[nodiscard]] double neck_radius(double adhesion, double modulus, double radius);
/// Greatest gap that a neck spans, 3 c^2 / R [m].
[[nodiscard]] double neck_reach(double adhesion, double modulus, double radius);

/// Fills in lanes.contact_radius and the elastic part of lanes.normal; both are 0 where bodies have no neck. Pairs without
/// adhesion get Hertz' law.
/// @param slot of the history: 1 where a neck holds, else 0.
void find_necks(ContactBatch& batch, const Lane& adhesion, const Lane& modulus, std::size_t slot, ContactLanes& lanes);

}  // namespace scree::granular
