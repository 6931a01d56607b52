// Block projected Gauss-Seidel for cone complementarity problems (Tasora &
// Anitescu 2010, 2011): block after block, each with the velocities that the ones
// before it left. General blocks first, then the contacts.
#pragma once

#include <vector>

#include "scree/ccp/delassus.hpp"
#include "scree/ccp/sweep/block_sweep.hpp"
#include "scree/ccp/sweep/contact_sweep.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// What a scene can say about pgs.
struct PgsOptions {
  double relaxation = 1.0;   ///< omega [1], in (0, 1.9]
  bool scalar_step = false;  ///< one step length for all three rows of a contact
  bool coloured = false;     ///< order by colours, for several threads
  int check_interval = 10;   ///< sweeps between two computations of the residual
};

/// The objective falls with every update. No allocation once the workspace has
/// its size.
class Pgs final : public CcpSolver {
 public:
  explicit Pgs(const PgsOptions& options) : options_{options} {}
  explicit Pgs(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;
  void release_workspace() override;

 private:
  bool prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma);
  void sweep(const Executor* executor);
  /// Of the impulses and velocities that the sweeps left.
  double residual(std::span<double> gamma);
  /// Of the impulses alone, from which the velocities are made anew.
  double refreshed_residual(std::span<double> gamma);

  PgsOptions options_;
  DelassusOperator delassus_;
  ContactSweep contacts_;
  BlockSweep blocks_;
  std::vector<Twist> w_;
  std::vector<double> partial_;
  std::vector<double> guess_;
};

}  // namespace scree
