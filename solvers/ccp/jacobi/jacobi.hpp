// Block projected Jacobi for cone complementarity problems: all contacts at
// once, each with the velocities of the iterate before.
//
//     x_i <- P_i( x_i - omega S_i^-1 u_i ),      u = N x + r
//
// Glossary: c_k, the number of contacts and other blocks of body k; N_ii^k, what
// body k adds to the block N_ii; S_i = diag(s_n, s_t, s_t), the stiffness of the step; omega,
// the relaxation [1].
//
// Contacts of one body push it all at once, so that steps sized by N_ii alone
// overshoot and diverge. For vectors p_1 .. p_c of one body, |p_1 + ... + p_c|^2 <=
// c (|p_1|^2 + ... + |p_c|^2) in the norm M^-1; with this
//
//     N <= diag_i( c_a N_ii^a + c_b N_ii^b + E_i ) <= S
//
// and for 0 < omega < 2 no step raises the objective (the splitting condition of
// Tasora & Anitescu 2011, theorem 1; the factor by body is sharper than the
// largest number of contacts of any body). A body with thousands of contacts, a
// drum, makes all their steps short: the price of doing them at once.
//
// With an explicit matrix whose row i has c_i blocks that are not zero, N <= diag_i(c_i
// N_ii) for the same reason. General blocks take the steps of block_step.hpp with
// these bounds in place of N_ii.
#pragma once

#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/sweep/block_step.hpp"
#include "scree/ccp/sweep/local_step.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// What a scene can say about jacobi.
struct JacobiOptions {
  double relaxation = 1.8;  ///< omega [1], in (0, 1.9]
  int check_interval = 10;  ///< iterations between two computations of the residual
};

/// The objective falls with every iteration. No allocation once the workspace has
/// its size.
class Jacobi final : public CcpSolver {
 public:
  explicit Jacobi(const JacobiOptions& options) : options_{options} {}
  explicit Jacobi(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;

 private:
  bool prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma);
  void prepare_steps(const CcpProblem& problem);
  void iterate(std::span<double> gamma);
  void advance_contact(std::size_t i, std::span<double> gamma);
  /// `before`: the impulses that the velocities belong to.
  void advance_block(std::size_t k, std::span<const double> before, std::span<double> gamma);

  JacobiOptions options_;
  DelassusOperator delassus_;
  std::vector<double> units_of_;       ///< c_k, per body
  std::vector<double> neighbours_of_;  ///< c_i, per block of a matrix
  sweep::BlockSteps block_steps_;
  std::vector<sweep::LocalStep> steps_;
  std::vector<Twist> w_, slots_;
  std::vector<double> partial_, guess_, before_;
};

}  // namespace scree
