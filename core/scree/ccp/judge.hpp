// The one judge of all CCP solvers.
//
//     residual = max_i || g_i - P_i(g_i - s_i (N g + r)_i) || / s_i,
//     s_i = rows_i / trace(N_ii)
//
// a velocity error [m/s] that is zero exactly at a solution: the natural map of
// the complementarity problem, contact by contact and block by block in its own
// mass (Tasora & Anitescu 2011, eq. 39, made independent of units and of mass
// ratios). P_i projects on what the unit's impulses may be: a cone, an interval a
// row, everything. Units with a zero N_ii, which no impulse changes, are left out:
// no solver can do anything about them.
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
  /// The same two for exact Coulomb friction: u_n + mu ||u_t|| + spinning |u_s| + rolling ||u_rho|| in place of the u_n
  /// of a cone (De Saxce & Feng 1998).
  double coulomb_residual = 0.0;  ///< [m/s]
  double coulomb_error = 0.0;     ///< [1]
  double objective = 0.0;         ///< 1/2 gamma^T N gamma + r^T gamma [J]
  /// How far an impulse is outside its bounds at most; 0 for none [N s].
  double impulse_violation = 0.0;
  /// How far a velocity is outside K* at most [m/s]: u_n below mu ||u_t|| + ..., u < 0 of a row that can only push, any u of
  /// a row without bounds. Units that no impulse changes count here, and in the gap below.
  double velocity_violation = 0.0;
  /// Sum of |gamma_i . u_i| over the units [J]; a bound of a box counts as the impulse's zero.
  double complementarity_gap = 0.0;
};

/// Computes residuals; keeps its memory between problems.
class CcpJudge {
 public:
  /// The residual of `gamma` (one number a row) [N s] for `problem` [m/s]; infinite when a
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

/// Square of the residual of one block [m2/s2]: impulse `g` [N s], velocity `u` [m/s], `trace` of N_ii [1/kg], above zero.
[[nodiscard]] double squared_block_residual(const CcpBlock& block, std::span<const double> g, std::span<const double> u,
                                            double trace);

/// The residual of `operator_`'s problem for the impulses `gamma` [N s] and the
/// body velocities w = M^-1 D gamma that belong to them [m/s]. `partial` is
/// workspace.
[[nodiscard]] double ccp_residual(const DelassusOperator& delassus, std::span<const double> gamma,
                                  std::span<const Twist> w, std::vector<double>& partial);

/// The residual by CcpJudge with workspace of its own [m/s].
[[nodiscard]] double ccp_residual(const CcpProblem& problem, std::span<const double> gamma,
                                  const Executor* executor = nullptr);

}  // namespace scree
