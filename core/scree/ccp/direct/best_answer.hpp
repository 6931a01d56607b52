// BestAnswer: the iterate with the least residual that is not above the guess in the objective.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree::direct {

/// Judges iterates and keeps the best one in the caller's array.
class BestAnswer {
 public:
  /// Projects the guess in `gamma`, which receives every better answer from then on. False when r is not finite.
  bool start(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma);
  /// The residual of `gamma` [m/s], which lies in K. It becomes the answer when it is better.
  double offer(std::span<const double> gamma);
  [[nodiscard]] bool good_enough() const { return residual_ <= tolerance_; }
  [[nodiscard]] double residual() const { return residual_; }
  [[nodiscard]] std::span<const double> gamma() const { return gamma_; }
  /// Puts the residual into `summary`, and the status that it deserves.
  void conclude(SolveSummary& summary) const;

  /// N gamma + r of the projected guess [m/s], one number a row.
  void velocities_of_guess(std::span<double> u) const;
  /// trace(N_ii) of every unit [1/kg].
  [[nodiscard]] std::span<const double> traces() const { return delassus_.traces(); }

 private:
  DelassusOperator delassus_;
  std::span<double> gamma_;
  double tolerance_ = 0.0, residual_ = 0.0, guess_residual_ = 0.0;
  std::vector<double> guess_, guess_velocities_, velocities_, partial_;
  std::vector<Twist> w_;
};

}  // namespace scree::direct
