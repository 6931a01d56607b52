// Exact Coulomb friction over any CCP solver.
//
// The associated (convex) problem lets a sliding contact separate with u_n =
// mu ||u_t||. De Saxce's change of variable takes that back: the CCP with
//     r_n + s,   s = mu ||u_t||   (De Saxce & Feng 1998; Acary & Brogliato 2008)
// has u_n = 0 where it slides. s is found by a fixed point: a CCP for given s,
// then s from its answer. For one sliding contact the step length 1 + mu^2
// N_tt / N_nn makes that Newton's method; it is taken back towards, then below, 1
// whenever the error fails to fall. The s with the least error is kept.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/interfaces/time_stepper.hpp"

namespace scree::dvi {

/// When to stop.
struct CoulombLimits {
  double tolerance = 1e-3;  ///< greatest change of s [m/s]
  int max_solves = 50;      ///< CCPs solved
};

/// What was done.
struct CoulombSummary {
  SolveSummary solve;  ///< iterations: sum over all CCPs; status: iteration_limit when s did not settle
  int solves = 0;      ///< CCPs solved
  double error = 0.0;  ///< max_i |s_i - mu ||u_t||_i| of the answer [m/s]
};

/// The fixed point. Keeps its memory between steps.
class CoulombFixedPoint {
 public:
  /// Solves `problem` with exact Coulomb friction. `delassus` is bound to it;
  /// `gamma` (3 m) [N s]: guess and answer.
  CoulombSummary solve(StepServices& services, const CcpProblem& problem, DelassusOperator& delassus,
                       const CoulombLimits& limits, std::span<double> gamma);

 private:
  double update_errors(const CcpProblem& problem);

  std::vector<double> r_;       ///< r with s added
  std::vector<double> u_;       ///< N gamma + r
  std::vector<double> s_;       ///< per contact
  std::vector<double> best_s_;  ///< s with the least error so far
  std::vector<double> error_;   ///< mu ||u_t|| - s, per contact
  std::vector<double> best_error_;
  std::vector<double> boost_;  ///< mu^2 N_tt / N_nn, per contact
  std::vector<double> best_gamma_;
};

}  // namespace scree::dvi
