// Spectral projected gradient for cone complementarity problems (Birgin,
// Martinez, Raydan 2000, SIAM J. Optim. 10:1196, algorithm SPG2; steps: Barzilai,
// Borwein 1988; each used several times: Dai, Hager, Schittkowski, Zhang 2006).
//
// Glossary: x, the iterate [N s]; u = N x + r, the gradient [m/s]; D, a diagonal
// metric made of the diagonal of N [1/kg]; P, the projection on the cones in the
// metric; alpha, the spectral step [1]; lambda, that of the line search [1]; w =
// M^-1 D_J x, body velocities (D_J: the Jacobian); v = M^-1 D_J d.
//
//     d = P(x - alpha D^-1 u) - x,      x <- x + lambda d,      w <- w + lambda v
//     alpha <- d^T D d / d^T N d  (BB1)  or  d^T N d / (N d)^T D^-1 (N d)  (BB2)
//
// An iteration makes one product N d, and with BB1 not even all of it: d^T N d =
// v^T M v is a sum over bodies, and the next gradient comes from w. So it is one
// pass over the units, which finishes the step before, takes the gradient,
// makes d and adds it up for the bodies, and one over the bodies. BB2 needs N d
// at the contacts: a second, lighter pass. With an explicit matrix N x follows x
// as w does.
#pragma once

#include <vector>

#include "contact_direction.hpp"
#include "line_search.hpp"
#include "scree/ccp/packed/confirmation.hpp"
#include "scree/ccp/packed/packed_problem.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// What a scene can say about spg.
struct SpgOptions {
  using Scaling = packed::Scaling;
  enum class Step { bb1, bb2, alternating };  ///< the spectral step; alternating: BB1, BB2, BB1...
  Scaling scaling = Scaling::block;
  Step step = Step::bb1;
  int hold = 4;             ///< iterations that use one spectral step
  int memory = 10;          ///< iterates that the line search compares with; 1: monotone
  int check_interval = 10;  ///< iterations between two computations of the residual
};

/// Returns the iterate with the least residual seen. No allocation once the
/// workspace has its size.
class Spg final : public CcpSolver {
 public:
  explicit Spg(const SpgOptions& options) : options_{options} {}
  explicit Spg(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;
  void release_workspace() override;

  /// Trials that the line search refused in the last solve.
  [[nodiscard]] int reductions() const { return search_.reductions(); }

 private:
  using Sums = spg::Sums;

  void prepare(const CcpProblem& problem, const SolveContext& context, std::span<const double> gamma);
  SolveStatus descend(const SolveContext& context, SolveSummary& summary);
  bool iterate(int iteration, double* residual);
  void choose_step(int iteration, const Sums& sums);
  double look(SolveSummary& summary);
  void keep_best(SolveSummary& summary, double residual, double change);

  template <bool compliant, bool looking>
  Sums contact_range(const packed::Run& run);
  Sums block_range(const packed::Run& run, bool looking);
  Sums unit_pass(double* residual);
  double body_pass();
  double matrix_pass();
  void move_slots();
  double product_norm();
  double product_norm_of(const packed::Run& run);
  void finish_step();
  void refresh();

  SpgOptions options_;
  DelassusOperator delassus_;
  packed::PackedProblem packed_;
  packed::Confirmation confirmation_;
  spg::LineSearch search_;
  packed::Impulses x_, d_, x_best_;          ///< impulses, direction [N s]
  std::vector<packed::Twists> w_, v_;        ///< of four bodies each
  std::vector<double> product_, product_d_;  ///< N x, N d of problems with a matrix [m/s]
  std::vector<Sums> sums_;
  std::vector<double> partial_;
  int hold_ = 1;  ///< iterations that use one spectral step, now
  double alpha_ = 1.0;
  double pending_ = 0.0;  ///< lambda that x and w have not moved by yet; the slots have [1]
  bool fresh_ = true;     ///< w was made from x, not updated
};

}  // namespace scree
