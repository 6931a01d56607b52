// Narrow phase `bullet`: Bullet's GJK and EPA on every pair of convex solids.
#pragma once

#include "convex_phase.hpp"

namespace scree {

/// Bullet called pair by pair, in double precision, on solids of unit size without margins.
class BulletNarrowPhase final : public convex::ConvexPhase {
 protected:
  [[nodiscard]] convex::Answer ask(const convex::ConvexSolid& a, const convex::ConvexSolid& b) const override;
};

}  // namespace scree
