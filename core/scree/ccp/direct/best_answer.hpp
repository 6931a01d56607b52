// BestAnswer: the iterate with the least residual that is not above the guess in the objective.
//
// Where there is no answer iterates grow along a direction d of K in which nothing resists, N d = 0, and which r pushes on, r.d < 0:
// for every answer g, 0 <= d.(N g + r) = (N d).g + r.d. So every answer has an impulse of at least
//
//     |r.d| / sum_i ||(N d)_i|| n_i        times n_i = max|r| / (trace(N_ii) / rows_i),
//
// the impulse that stops the fastest unit alone. Beyond kBeyond times it the problem is called infeasible.
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
  /// No answer is within kBeyond times the impulses that the problem's units need alone.
  [[nodiscard]] bool infeasible() const { return infeasible_; }
  static constexpr double kBeyond = 1e8;  ///< [1]
  /// Good enough, or there is nothing to be found.
  [[nodiscard]] bool done() const { return residual_ <= tolerance_ || infeasible_; }
  [[nodiscard]] double residual() const { return residual_; }
  [[nodiscard]] std::span<const double> gamma() const { return gamma_; }
  /// Puts the residual into `summary`, and the status that it deserves.
  void conclude(SolveSummary& summary) const;

  /// The objective of the projected guess is above that of no impulses at all, which K allows.
  [[nodiscard]] bool guess_is_above_zero() const;
  /// N gamma + r of the projected guess [m/s], one number a row.
  void velocities_of_guess(std::span<double> u) const;
  /// trace(N_ii) of every unit [1/kg].
  [[nodiscard]] std::span<const double> traces() const { return delassus_.traces(); }

 private:
  /// Sets infeasible_; true when w_ is no longer that of `gamma`.
  bool look_for_a_certificate(std::span<const double> gamma);

  DelassusOperator delassus_;
  std::span<double> gamma_;
  double tolerance_ = 0.0, residual_ = 0.0, guess_residual_ = 0.0;
  std::vector<double> guess_, guess_velocities_, velocities_, partial_;
  std::vector<Twist> w_;
  bool infeasible_ = false;
  double speed_ = 0.0;             ///< max |r| [m/s]
  std::vector<double> previous_;   ///< iterate [N s]
  std::vector<double> direction_;  ///< d, from it to the present one [N s]
};

}  // namespace scree::direct
