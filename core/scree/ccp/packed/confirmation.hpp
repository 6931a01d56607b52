// Confirmation: what the judge says of impulses that the passes here find good enough.
//
// The passes add up the judge's terms in another order, and so see rounding of another sign. Of impulses p on a light body it
// makes velocities of about eps ||p|| / m, where ||p|| may be what a heavy body needs: 1e-16 times the ratio of their masses
// times the speeds. Where that comes near the tolerance, or the numbers leave the range in which the passes' squares have
// room, the word of a pass is not enough. Elsewhere asking the judge would take its time for nothing.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/judge.hpp"
#include "scree/ccp/packed/packed_problem.hpp"

namespace scree::packed {

/// Refers to what it was started with; asks for memory only when it is needed.
class Confirmation {
 public:
  /// `guess`: projected, as solves start from it; `tolerance` [m/s].
  void start(const DelassusOperator& delassus, std::span<const double> guess, double tolerance,
             const Executor* executor);
  /// Whether rounding may hide a residual above the tolerance.
  [[nodiscard]] bool needed() const { return needed_; }
  /// `seen`, the residual of `x` that a pass found [m/s], or what the judge says of it where that matters.
  double residual(const PackedProblem& packed, const Impulses& x, double seen);
  /// The same of impulses that are one number a row.
  double residual(const CcpProblem& problem, std::span<const double> gamma, double seen);
  void release_memory();

 private:
  const Executor* executor_ = nullptr;
  double tolerance_ = 0.0;
  bool needed_ = false;
  CcpJudge judge_;
  std::vector<double> guess_, gamma_;  ///< [N s]
};

}  // namespace scree::packed
