// Exact Coulomb friction over any solver of CCPs, and matrices that are symmetric only in theory.
//
// The associated (convex) problem lets a sliding contact separate with u_n = mu ||u_t||. De Saxce's change of variable takes
// that back: the CCP with
//
//     r_n + s,   s = mu ||u_t|| + spinning |u_s| + rolling ||u_rho||    (De Saxce & Feng 1998; Acary & Brogliato 2008)
//
// has u_n = 0 where it slides. s is found as a fixed point: a CCP for a given s, then s from its answer. By itself that may
// turn in circles; so the steps are mixed (anderson.hpp), a step that leads nowhere begins again from the best point with half
// the length, and the best answer is kept. The CCPs are solved only as well as the s that they are for deserves.
//
// Solvers minimise, and need a symmetric N. One with a small skew part A is given as (N + N^T)/2, with A gamma of the answer
// before added to r: another fixed point, in the same iteration.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "scree/ccp/anderson.hpp"
#include "scree/ccp/delassus.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// How far a CCP within the iteration is to be solved.
struct InnerGoal {
  double tolerance = 0.0;  ///< ccp_residual [m/s]
  int max_iterations = 0;
};

/// Solves a CCP; `gamma` [N s]: guess in, answer out.
using InnerSolve = std::function<SolveSummary(const CcpProblem&, const InnerGoal&, std::span<double> gamma)>;

/// What is to be solved, and when to stop.
struct CoulombLimits {
  double tolerance = 1e-3;                               ///< velocity error of the exact conditions [m/s]
  int max_solves = 50;                                   ///< CCPs solved
  int max_iterations = std::numeric_limits<int>::max();  ///< of all CCPs together
  bool coulomb = true;                                   ///< false: only for N that is not symmetric
  /// The solver stops where it wants: whoever calls has no say. What then has to settle to `tolerance` is s.
  bool solver_has_its_own_goal = false;
};

/// What was done.
struct CoulombSummary {
  SolveSummary solve;  ///< of the CCP whose answer was kept; iterations: of all
  int solves = 0;      ///< CCPs solved
  /// What the exact conditions still lack [m/s]: their residual (CcpFigures::coulomb_residual), or the greatest change of s
  /// where the solver has its own goal.
  double error = 0.0;
};

/// r of the exact problem of an answer `gamma` [N s]: that of `problem` with the answer's own s in its normal rows [m/s].
[[nodiscard]] std::vector<double> exact_r(const CcpProblem& problem, std::span<const double> gamma,
                                          const Executor* executor);

/// The iteration; keeps its memory between problems.
class CoulombIteration {
 public:
  /// Solves `problem`; `gamma` (one a row) [N s]: guess and answer. The status is that of the whole: converged when `error` is
  /// within the tolerance, stalled when shorter and shorter steps led nowhere.
  CoulombSummary solve(const CcpProblem& problem, const Executor& executor, const InnerSolve& inner,
                       const CoulombLimits& limits, std::span<double> gamma);

 private:
  /// A point of the iteration: what it was made from, and what came of it.
  struct Point {
    std::vector<double> s, f;  ///< per unit; f: the s that follows, less s [m/s]
    SolveSummary solve;
    double error = std::numeric_limits<double>::infinity();
  };
  void bind(const CcpProblem& problem, const Executor& executor);
  void look(std::span<const double> gamma, const CoulombLimits& limits);
  void pose(std::span<const double> gamma);
  bool advance(std::span<double> gamma);
  void iterate(const InnerSolve& inner, const CoulombLimits& limits, std::span<double> gamma, CoulombSummary& summary);

  CcpProblem given_;
  CcpProblem exact_;            ///< given_ with the s of the answer in r
  CcpProblem posed_;            ///< what the solver gets: symmetric, with the iteration's s in r
  DelassusOperator delassus_;   ///< of exact_
  DelassusOperator symmetric_;  ///< of posed_, where N is not symmetric
  std::vector<double> values_;  ///< of the symmetric matrix; empty when N is
  std::vector<double> exact_r_, posed_r_;
  std::vector<double> u_, symmetric_u_;  ///< N gamma; its symmetric part
  std::vector<Twist> w_;
  std::vector<double> partial_;
  Point now_, best_;
  std::vector<double> best_gamma_;
  AndersonMixing mixing_;
  double damping_ = 1.0;
  double ahead_ = 0.0;  ///< accuracy of the CCPs, over the error of s [1]
  int without_gain_ = 0;
};

}  // namespace scree
