// Broad phase `fcl_tree`: FCL's dynamic tree of bounding boxes, kept between steps.
#pragma once

#include <memory>

#include "scree/interfaces/broad_phase.hpp"

namespace scree {

/// Two trees, of the movable boxes and of the others. What they remember does not show in the result, so it is not saved.
class FclTree : public BroadPhase {
 public:
  FclTree();
  ~FclTree() override;
  void find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) override;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace scree
