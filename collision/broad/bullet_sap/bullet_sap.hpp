// Broad phase `bullet_sap`: Bullet's sweep and prune along three axes (btAxisSweep3 and its 32-bit form), kept between steps.
#pragma once

#include <memory>

#include "scree/interfaces/broad_phase.hpp"

namespace scree {

class BulletProxies;

/// The ends of all boxes lie sorted along each axis, as integers of a grid over the scene; a step sorts them again by
/// exchanging neighbours. What the lists remember does not show in the result, so it is not saved.
class BulletSap : public BroadPhase {
 public:
  BulletSap();
  ~BulletSap() override;
  void find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) override;

 private:
  void make_room(const BoxView& boxes);

  std::unique_ptr<BulletProxies> proxies_;
  Aabb world_;                ///< boxes outside of it make Bullet's lists long [m]
  std::size_t capacity_ = 0;  ///< boxes that Bullet's lists have room for
};

}  // namespace scree
