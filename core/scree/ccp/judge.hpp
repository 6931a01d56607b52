// The one judge of all CCP solvers.
//
//     residual = max_i || g_i - P_i(g_i - s_i (N g + r)_i) || / s_i,
//     s_i = 3 / trace(N_ii)
//
// a velocity error [m/s] that is zero exactly at a solution: the natural map of
// the complementarity problem, block by block in the block's own mass (Tasora &
// Anitescu 2011, eq. 39, made independent of units and of mass ratios).
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/problem.hpp"

namespace scree {

/// All that is said about an answer gamma, with u = N gamma + r; P projects on K.
struct CcpFigures {
  double residual = 0.0;           ///< as above [m/s]
  double relative_residual = 0.0;  ///< ||gamma - P(gamma - u)||_2 / ||r||_2, unscaled numbers [1]
  /// The same for exact Coulomb friction: u_n + mu ||u_t|| in place of u_n (De Saxce & Feng 1998) [1].
  double coulomb_error = 0.0;
  double objective = 0.0;  ///< 1/2 gamma^T N gamma + r^T gamma [J]
};

/// Computes residuals; keeps its memory between problems.
class CcpJudge {
 public:
  /// The residual of `gamma` (3 m) [N s] for `problem` [m/s]; infinite when a
  /// number is not finite. `executor` may be null.
  double residual(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor);
  /// Everything about `gamma`. The relative figures mix impulses [N s] with velocities [m/s], as the literature on
  /// solvers does; where ||r|| = 0 they are not divided.
  CcpFigures figures(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor);

 private:
  DelassusOperator delassus_;
  std::vector<Twist> w_;
  std::vector<double> partial_;
  std::vector<double> u_;
};

/// The residual of `operator_`'s problem for the impulses `gamma` [N s] and the
/// body velocities w = M^-1 D gamma that belong to them [m/s]. `partial` is
/// workspace.
[[nodiscard]] double ccp_residual(const DelassusOperator& delassus, std::span<const double> gamma,
                                  std::span<const Twist> w, std::vector<double>& partial);

/// The residual by CcpJudge with workspace of its own [m/s].
[[nodiscard]] double ccp_residual(const CcpProblem& problem, std::span<const double> gamma,
                                  const Executor* executor = nullptr);

}  // namespace scree
