// The sum of all force fields, and the search for the one that went wrong.
#pragma once

#include <span>
#include <vector>

#include "scree/interfaces/force_field.hpp"
#include "scree/simulation/part.hpp"

namespace scree {

/// Writes the sum of the forces [N] and torques [N m] of `fields` at `time` [s] to `out`.
/// @throws Error (diverged) naming the field and the body whose entry is not finite.
void sum_forces(std::span<const Part<ForceField>> fields, const BodyView& bodies, double time, WrenchView out);

}  // namespace scree
