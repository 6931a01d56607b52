// BroadPhase: from boxes to pairs of boxes that meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/collision/collider.hpp"
#include "scree/interfaces/plugin.hpp"

namespace scree {

class Executor;

/// Boxes of one step; spans of equal length.
struct BoxView {
  std::span<const std::uint64_t> key;    ///< stable, for phases that keep a structure between steps
  std::span<const Aabb> box;             ///< bounded boxes [m], world
  std::span<const char> movable;         ///< pairs of two unmovable boxes are not wanted
  std::span<const std::uint32_t> owner;  ///< pairs of the same owner (body) are not wanted
  /// Balls that hold what can meet within the step; empty, or one a box: a pair whose balls are apart may be left out.
  std::span<const BoundingBall> ball = {};

  [[nodiscard]] std::size_t size() const { return key.size(); }
};

/// Finds candidate pairs. What it reports is a superset: the host drops pairs
/// whose boxes do not meet, sorts, and removes doubles, so that no history of
/// the phase shows in the result.
class BroadPhase : public Plugin {
 public:
  static constexpr const char* kKind = "broad_phase";
  ~BroadPhase() override;

  /// Appends every pair of boxes that overlap (touching counts) and whose balls do, if there are balls, each index into
  /// `boxes`, to `out`, at least once.
  virtual void find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) = 0;
};

}  // namespace scree
