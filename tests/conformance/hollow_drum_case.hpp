// Solids inside a hollow cylinder, a drum seen from inside, for judging narrow phases that support it.
//
// The free space is convex, so that what a wall leaves free is known from the solid's support function h alone: the mantle
// r - max over the directions d across the axis of h(d), a lid half length - h(+-z).
#pragma once

#include <array>
#include <string>

#include "conformance/narrow_phase_solids.hpp"
#include "scree/interfaces/narrow_phase.hpp"

namespace scree::test {

/// A solid in a drum, and what is true of it.
struct DrumPose {
  PrimitiveData drum, solid;
  Pose drum_pose, pose;
  bool drum_first = true;  ///< the drum is body a
  double size = 0.0;       ///< of the solid [m]
  double reach = 0.0;      ///< [m]
  /// Of the mantle, the lid at +z and that at -z [m].
  std::array<double, 3> gap{};
  std::string description;
};

/// What the mantle of a drum, to whose frame `parts` are placed, leaves free [m]; at direction `angle` about its axis [rad].
[[nodiscard]] double mantle_gap_along(double radius, const std::vector<ReferenceSolid>& parts, double angle);

/// The pose number `trial` of a kind of solid: near the mantle, near a lid, near both, apart or in the wall.
[[nodiscard]] DrumPose drum_pose(ShapeKind inside, int trial);

/// What is wrong with the contacts of a phase at a pose; empty when nothing is. Of each wall within reach there is a contact
/// with its gap to 1e-3 of the size and a normal along which the mantle leaves as little free, to 5e-4; none is deeper or
/// farther than is true.
[[nodiscard]] std::string fault_of(NarrowPhase& phase, const DrumPose& pose);

}  // namespace scree::test
