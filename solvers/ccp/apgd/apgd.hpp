// Accelerated projected gradient descent for cone complementarity problems
// (Mazhar, Heyn, Tasora, Negrut 2015, ACM TOG 34:32; Nesterov 1983; restart:
// O'Donoghue & Candes 2015).
//
// Glossary: x, the iterate; y = x + beta (x - x_old), the point where the
// gradient is taken; D, a diagonal metric made of the diagonal of N; t, the step;
// P, the projection on the cones in the metric; p = D_J x, the sums of impulses
// of each body (D_J: the Jacobian).
//
//     x_new = P(y - t D^-1 (N y + r))
//
// N y is never computed from y: body sums are linear, so p(y) = p(x) + beta
// (p(x) - p(x_old)). Hence an iteration is one pass over the units, which
// reads velocities of y, makes x_new and adds it up for the bodies, and a cheap
// pass over the bodies. With an explicit matrix N y is combined from N x and N
// x_old in the same way. The quantities of the step test and of the restart
// fall out of the same passes:
//
//     (x_new - y)^T N (x_new - y) <= 1/t ||x_new - y||_D^2     or t shrinks
//     (x_new - y)^T D (x_new - x) >= 0                         or momentum is dropped
//
// x_new is written over x_old. A step that has to shrink therefore starts again
// from x, without momentum.
#pragma once

#include <vector>

#include "contact_step.hpp"
#include "scree/ccp/packed/confirmation.hpp"
#include "scree/ccp/packed/packed_problem.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// What a scene can say about apgd.
struct ApgdOptions {
  bool scaled = true;       ///< per-contact metric; false: one length for all, as in the paper
  bool restart = true;      ///< drop the momentum when it points uphill
  double growth = 1.0;      ///< factor on the step after each accepted one [1]
  int check_interval = 10;  ///< iterations between two computations of the residual
};

/// Returns the iterate with the least residual seen. No allocation once the
/// workspace has its size.
class Apgd final : public CcpSolver {
 public:
  explicit Apgd(const ApgdOptions& options) : options_{options} {}
  explicit Apgd(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;
  void release_workspace() override;

 private:
  using Sums = apgd::Sums;

  void prepare(const CcpProblem& problem, const SolveContext& context, std::span<const double> gamma);
  void start();
  template <bool compliant>
  Sums contact_range(const packed::Run& run);
  Sums block_range(const packed::Run& run);
  void block_gradient(std::size_t block, std::span<const double> y, std::span<double> u) const;
  Sums unit_pass();
  Sums body_pass(double beta_next);
  Sums matrix_pass();
  void spread_velocities(double beta);
  void move_to(double beta);
  bool iterate();
  void look(SolveSummary& summary, double start, std::span<double> gamma);
  double residual();
  /// Of x_ [J], once its residual has been computed.
  [[nodiscard]] double objective() const { return 0.5 * quadratic_ + linear_; }
  SolveStatus descend(const SolveContext& context, SolveSummary& summary, std::span<double> gamma);

  ApgdOptions options_;
  DelassusOperator delassus_;
  packed::PackedProblem packed_;
  packed::Confirmation confirmation_;
  packed::Impulses x_, x_old_;                 ///< [N s]
  std::vector<packed::Twists> p_, p_old_;      ///< sums of four bodies each [N s]
  std::vector<double> product_, product_old_;  ///< N x, N x_old of problems with a matrix [m/s]
  std::vector<double> y_, product_y_;          ///< y and N y of such problems
  std::vector<Sums> partial_;
  double theta_ = 1.0, beta_ = 0.0;  ///< of the next step [1]
  double spread_ = -1.0;             ///< beta of the y whose velocities the slots have; below zero: of none
  double step_ = 1.0;                ///< t [1]
  double pace_ = 0.0;                ///< ||x_new - y||_D / t, which falls with the residual
  double residual_per_pace_ = 0.0;   ///< at the last look
  double quadratic_ = 0.0;           ///< x_^T N x_ [J]
  double linear_ = 0.0;              ///< r^T x_, as of the last look [J]
};

}  // namespace scree
