// ActiveSetSolve: solves a CCP by the contacts that matter.
//
// A step's problem holds every contact that may close within the step, and in a fast stream most of them never do. The
// contacts that the guess leaves open are put aside; the others are solved; those aside that the answer would close are added,
// and the solve goes on from there. When none is left, the answer solves the whole problem: a contact that opens by itself
// carries no impulse. Blocks of other kinds always count, and a problem without contacts goes to the solver as it is. The
// judge sees the whole problem in any case.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// Solves whole problems through their active contacts. Keeps its memory between calls, and no information.
class ActiveSetSolve {
 public:
  /// As CcpSolver::solve(), with `solver` for the parts. All rounds together take at most context.max_iterations of its
  /// iterations. The residual is that of the whole problem; those that on_iteration gets on the way are of the part being
  /// solved.
  SolveSummary solve(CcpSolver& solver, const CcpProblem& problem, const SolveContext& context,
                     std::span<double> gamma);

 private:
  /// Marks the contacts aside whose error without impulse exceeds `tolerance` [m/s]; returns how many.
  std::size_t add_violated(std::span<const double> gamma, double tolerance);
  /// Marks what the guess does not leave open; returns how many are marked.
  std::size_t mark_guess(const CcpProblem& problem, const SolveContext& context, std::span<const double> gamma);
  /// The rounds, until the part is solved and nothing is missing, or the work is done, or so much of the problem is `active`
  /// that the rest is better solved with it.
  SolveSummary solve_rounds(CcpSolver& solver, const SolveContext& context, std::size_t& active,
                            std::span<double> gamma);
  SolveSummary solve_active(CcpSolver& solver, const SolveContext& context, std::size_t active,
                            std::span<double> gamma);

  DelassusOperator delassus_;  ///< of the whole problem
  std::vector<char> active_;
  std::vector<std::uint32_t> index_;
  std::vector<CcpContact> contacts_;
  std::vector<double> r_, compliance_, gamma_, partial_;
  std::vector<Twist> w_;
};

}  // namespace scree
