// Narrow phase `fcl`: libccd's GJK and EPA, as FCL drives them, on every pair of convex solids.
#pragma once

#include "convex_phase.hpp"

namespace scree {

/// FCL's signed distance, pair by pair, on solids of unit size.
class FclNarrowPhase final : public convex::ConvexPhase {
 protected:
  [[nodiscard]] convex::Answer ask(const convex::ConvexSolid& a, const convex::ConvexSolid& b) const override;
};

}  // namespace scree
