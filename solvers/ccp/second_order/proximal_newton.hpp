// Semi-smooth Newton steps in a proximal method of multipliers (Rockafellar 1976, SIAM J. Control Optim. 14:877; Li, Sun,
// Toh 2018, SIAM J. Optim. 28:433).
//
// Glossary: gamma, impulses [N s]; z, the state: body velocities in units of their masses, of which A z are the velocities
// of the rows [m/s] (see DirectSystem); v, what compliance E adds to them [m/s]; T, the metric, N_ii / sigma a unit [1/kg]; P,
// the projection on K; sigma, the penalty [1].
//
// Outer: gamma <- p(z, v), where z and v minimise the smooth and strongly convex
//
//     phi = 1/2 |z|^2 + 1/2 v.E^-1 v + max over g in K of [ -g.(A z + v + r) - 1/2 (g - gamma).T (g - gamma) ],
//     p = P(gamma - T^-1 (A z + v + r)),      grad phi = (z - A^T p, E^-1 v - p)
//
// Inner: Newton steps with a B of the generalised derivative of p, and a line search. v is eliminated unit by unit: with
// B' = (B^-1 + E)^-1 and q, w the mismatches z - A^T p, v - E p,
//
//     (I + A^T B' A) dz = -q + A^T B' w,      dv = -w - E B' (A dz - w)
//
// Only p is ever an answer: it lies in K. Impulses need not be unique: the outer steps are proximal.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/direct/best_answer.hpp"
#include "scree/ccp/direct/direct_system.hpp"
#include "scree/ccp/direct/projection_derivative.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree::second_order {

/// How the penalty grows from outer step to outer step.
struct PenaltyOptions {
  double first = 10.0;   ///< sigma of the first outer step [1]
  double growth = 10.0;  ///< its factor from one to the next [1]
  double most = 1e5;     ///< and its limit: rounding grows with it [1]
  bool bounded = true;   ///< and by what rounding allows for the tolerance
};

/// Works on a bound DirectSystem. Keeps its memory between calls.
class ProximalNewton {
 public:
  /// Steps from `start` [N s] until the answer is good enough, summary.iterations is context.max_iterations, or nothing
  /// helps: then the status is stalled. Adds its steps, one factorisation each, to `summary`.
  void run(direct::DirectSystem& system, const CcpProblem& problem, const PenaltyOptions& options,
           const SolveContext& context, std::span<const double> start, direct::BestAnswer& best, SolveSummary& summary);

  /// The same from the best answer so far, with other penalties, as often as that brings it nearer. Does nothing when that is good enough.
  void insist(direct::DirectSystem& system, const CcpProblem& problem, const SolveContext& context,
              direct::BestAnswer& best, SolveSummary& summary);

 private:
  void restart();
  void project(double step);
  double slope(double step, double constant, double linear);
  double state_product(std::span<const double> z, std::span<const double> v) const;
  void differentiate();
  void soften(std::size_t unit, std::span<double> root) const;
  void apply_roots(std::span<const double> x, std::span<double> out) const;
  bool newton_step();
  double search(double slope_at_zero);
  bool is_solved(double tolerance);
  [[nodiscard]] double bounded(double sigma, double tolerance) const;
  [[nodiscard]] double compliance(std::size_t row) const {
    return problem_->compliance.empty() ? 0.0 : problem_->compliance[row];
  }

  direct::DirectSystem* system_ = nullptr;
  const CcpProblem* problem_ = nullptr;
  std::vector<double> weight_;      ///< trace of each unit over its rows [1/kg]
  std::vector<double> centre_;      ///< gamma of the outer step [N s]
  std::vector<double> z_, q_, dz_;  ///< state, mismatch, direction
  std::vector<double> v_, w_, dv_;  ///< the same of what compliance adds [m/s]
  std::vector<double> u_, du_;      ///< A z + v + r, A dz + dv [m/s]
  std::vector<double> a_, p_;       ///< what is projected, and its projection [N s]
  std::vector<double> c_;           ///< roots of B'
  std::vector<double> rows_, state_;
  double sigma_ = 1.0;
};

}  // namespace scree::second_order
