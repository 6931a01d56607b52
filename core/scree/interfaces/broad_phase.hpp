// BroadPhase: from boxes to pairs of boxes that meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/collision/collider.hpp"
#include "scree/interfaces/plugin.hpp"

namespace scree {

class Executor;

/// Boxes of one step; spans of equal length, or empty where it says so.
struct BoxView {
  std::span<const std::uint64_t> key;    ///< stable, for phases that keep a structure between steps
  std::span<const Aabb> box;             ///< bounded boxes [m], world; empty for a phase that takes balls alone
  std::span<const char> movable;         ///< pairs of two unmovable boxes are not wanted
  std::span<const std::uint32_t> owner;  ///< pairs of the same owner (body) are not wanted
  /// Balls about what the boxes hold, without its motion; empty, or one a box. Infinite radius: meets nothing here. A pair may
  /// be left out when its balls, each grown by its margin, are apart.
  std::span<const BoundingBall> ball = {};
  std::span<const double> margin = {};  ///< one a ball: what its motion within the step adds to the radius [m]

  [[nodiscard]] std::size_t size() const { return owner.size(); }
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
  /// Without boxes, every pair whose grown balls meet.
  virtual void find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) = 0;

  /// True for a phase that needs no boxes where everything is a sphere: balls are less to write and to read.
  [[nodiscard]] virtual bool takes_balls_alone() const { return false; }
};

}  // namespace scree
