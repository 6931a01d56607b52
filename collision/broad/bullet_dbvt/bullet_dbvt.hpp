// Broad phase `bullet_dbvt`: Bullet's dynamic bounding volume trees
// (btDbvtBroadphase), kept between steps.
#pragma once

#include <memory>
#include <vector>

#include "scree/interfaces/broad_phase.hpp"

namespace scree {

class BulletProxies;

/// Boxes are followed by their key: those that moved out of their enlarged box
/// are put into the tree again, new keys are added, missing ones removed. What
/// the tree remembers does not show in the result, so it is not saved.
class BulletDbvt : public BroadPhase {
 public:
  BulletDbvt();
  ~BulletDbvt() override;
  void find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) override;

 private:
  void choose_scale(const BoxView& boxes);

  std::unique_ptr<BulletProxies> proxies_;
  std::vector<double> size_;
};

}  // namespace scree
