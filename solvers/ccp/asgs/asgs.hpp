// Accelerated symmetric Gauss-Seidel for cone complementarity problems: a
// Nesterov iteration whose step is a projected Gauss-Seidel sweep forwards and
// one backwards.
//
// For a quadratic, forward + backward Gauss-Seidel is one proximal gradient step
// in the metric N + L D^-1 L^T (D, L: diagonal and lower triangle of N by
// blocks), which majorises N and is far closer to it than a diagonal (Li, Sun,
// Toh 2016, Math. Program. 155:333, theorem 1). So it may be accelerated as any
// such step (Nesterov 1983; restart: O'Donoghue & Candes 2015). The theorem
// allows one block that is not smooth, and here every block has a cone: the
// iteration is guarded. No accepted pair of sweeps ends above the objective of
// the one before; where the accelerated pair would, it is undone and a plain one
// follows, whose every update goes downhill.
//
// Problems of contacts without compliance begin with conjugate steps
// (conjugate_steps.hpp) in place of Nesterov's, until these fail twice, or once
// end uphill.
//
// Isotropic bodies begin in single precision (single_sweep.hpp); all contacts end with updates of those alone that still miss the
// tolerance (sweep/southwell.hpp).
//
// Glossary: x, the iterate; y = x + beta (x - x_old), where a pair starts; w = M^-1
// D x, the body velocities, which obey the same linear combination, so that
// starting from y needs no product; d, the diagonal metric of the local steps.
//
// The objective is 1/2 w^T M w + r^T x + 1/2 x^T E x: a sum over bodies, and one
// over contacts that the backward sweep takes along. General blocks come before
// the contacts forwards, and after them backwards.
#pragma once

#include <vector>

#include "block_momentum.hpp"
#include "conjugate_steps.hpp"
#include "scree/ccp/delassus.hpp"
#include "scree/ccp/sweep/block_sweep.hpp"
#include "scree/ccp/sweep/contact_sweep.hpp"
#include "scree/ccp/sweep/southwell.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "single_sweep.hpp"

namespace scree {

/// What a scene can say about asgs.
struct AsgsOptions {
  bool accelerated = true;  ///< false: plain symmetric Gauss-Seidel
  bool restart = true;      ///< drop the momentum when it points against the step
  bool conjugate = true;    ///< begin with conjugate steps
  bool relaxed = true;      ///< end with updates of those contacts alone that still miss the tolerance
  bool single = true;       ///< begin in single precision where the problem allows it
  bool coloured = false;    ///< order by colours, for several threads
  int check_interval = 10;  ///< sweeps between two computations of the residual
};

/// Returns the iterate with the least residual seen. No allocation once the
/// workspace has its size.
class Asgs final : public CcpSolver {
 public:
  explicit Asgs(const AsgsOptions& options) : options_{options} {}
  explicit Asgs(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;

  /// Pairs of the last solve that were undone because they ended uphill.
  [[nodiscard]] int undone() const { return undone_; }

 private:
  static constexpr int kFailures = 2;  ///< of conjugate steps before Nesterov's take over

  /// Of the contacts of one group [N s]. With conjugate steps x_old is the y before.
  struct History {
    Lanes3 x_old, y;
  };
  bool prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma);
  void prepare_sweeps(const CcpProblem& problem);
  void prepare_inertias(const CcpProblem& problem);
  void extrapolate();
  template <class Start>
  void forward(const Start& start, const Executor* executor);
  void backward(const Executor* executor);
  void advance(bool both, const Executor* executor);
  void plan(bool uphill);
  void plan_momentum(bool against);
  bool plan_single(bool uphill);
  void go_back(double before);
  void undo();
  void keep_x();
  void return_to(std::span<const double> x);
  [[nodiscard]] bool failed(double before) const;
  double kinetic_energy();
  double objective();
  double residual(std::span<double> gamma);
  void refresh();
  void look(SolveSummary& summary);
  [[nodiscard]] bool takes_conjugate_steps(const CcpProblem& problem) const;
  [[nodiscard]] double single_goal(double tolerance) const;
  [[nodiscard]] double objective_of_x() const;
  void descend_single(const SolveContext& context, SolveSummary& summary);
  void meet_x();
  double look_single();
  void look_single(SolveSummary& summary, double start);
  void descend(const SolveContext& context, SolveSummary& summary);
  int look_distance(const SolveSummary& summary, double tolerance) const;
  bool may_finish(const SolveContext& context, const SolveSummary& summary) const;
  void finish(const SolveContext& context, SolveSummary& summary);

  AsgsOptions options_;
  DelassusOperator delassus_;
  ContactSweep contacts_;
  BlockSweep blocks_;
  BlockMomentum block_momentum_;
  std::vector<History> history_;  ///< per group
  std::vector<sweep::Body> old_;  ///< bodies as x_old has them
  std::vector<Mat3> inertia_;     ///< per body [kg m2], world; empty when all are isotropic
  std::vector<AsgsSums> sums_;    ///< per chunk of the sweep
  std::vector<double> partial_;
  std::vector<double> x_, x_best_, x_kept_;  ///< impulses [N s]
  std::vector<Twist> w_;
  ConjugateSteps steps_;
  SingleSweep single_;
  Southwell southwell_;
  int next_finish_ = 0;              ///< iteration from which southwell_ may try again
  bool conjugate_ = false;           ///< steps_ decides where the next pair starts, else beta_
  int failures_ = 0;                 ///< of steps_
  double theta_ = 1.0, beta_ = 0.0;  ///< Nesterov's
  double objective_ = 0.0;           ///< of the groups' impulses [J]
  double linear_ = 0.0,
         linear_old_ = 0.0;  ///< the contacts' part of it that is no kinetic energy; and before the last pair [J]
  double against_ = 0.0;     ///< sum of the last pair [J]
  int undone_ = 0;
};

}  // namespace scree
