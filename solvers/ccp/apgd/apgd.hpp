// Accelerated projected gradient descent for cone complementarity problems
// (Mazhar, Heyn, Tasora, Negrut 2015, ACM TOG 34:32; Nesterov 1983; restart:
// O'Donoghue & Candes 2015).
//
// Glossary: x, the iterate; y = x + beta (x - x_old), the point where the
// gradient is taken; D = diag(d_n, d_t, d_t) per contact, from the diagonal of
// N_ii: the metric; t, the step; P, the projection on the cones in the metric;
// p = D_J x, the sums of impulses of each body (D_J: the Jacobian).
//
//     x_new = P(y - t D^-1 (N y + r))
//
// N y is never computed from y: body sums are linear, so p(y) = p(x) + beta
// (p(x) - p(x_old)). Hence an iteration is one pass over the contacts, which
// reads velocities of y, makes x_new and adds it up for the bodies, and two cheap
// passes over the bodies. The quantities of the step test and of the restart
// fall out of the same passes:
//
//     (x_new - y)^T N (x_new - y) <= 1/t ||x_new - y||_D^2     or t shrinks
//     (y - x_new)^T D (x_new - x) > 0                          or momentum is kept
#pragma once

#include <vector>

#include "scree/ccp/cone3.hpp"
#include "scree/ccp/delassus.hpp"
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

 private:
  /// The metric of a contact.
  struct Metric {
    double normal = 0.0;   ///< 1 / d_n [kg]
    double tangent = 0.0;  ///< 1 / d_t [kg]
    ConeWeights weights;
  };
  /// Sums over a pass of the contacts.
  struct Sums {
    double distance = 0.0;   ///< ||x_new - y||_D^2 [J]
    double uphill = 0.0;     ///< (y - x_new)^T D (x_new - x) [J]
    double linear = 0.0;     ///< r^T x_new [J]
    double curvature = 0.0;  ///< (x_new - y)^T N (x_new - y) [J]
    double quadratic = 0.0;  ///< x_new^T N x_new [J]
    Sums& operator+=(const Sums& o);
  };

  bool prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma);
  void momentum_velocities(double beta);
  template <bool compliant>
  Sums contact_range(std::size_t first, std::size_t last, double beta, double step);
  Sums contact_pass(double beta, double step);
  Sums body_pass(double beta);
  bool descend(double beta, const SolveContext& context, SolveSummary& summary);
  void look(const SolveContext& context, SolveSummary& summary, double start);
  double residual();

  ApgdOptions options_;
  DelassusOperator delassus_;
  std::vector<Metric> metric_;
  std::vector<double> x_, x_old_, x_best_;  ///< impulses [N s]; a pass overwrites x_old_ by x_new
  std::vector<double> x_new_;
  std::vector<Twist> p_, p_old_, p_new_;  ///< sums per body [N s]
  std::vector<Twist> slots_, w_;
  std::vector<Sums> partial_;
  std::vector<double> residual_partial_;
  double step_ = 1.0;       ///< t [1]
  double objective_ = 0.0;  ///< of x_ [J]
  double uphill_ = 0.0;     ///< of the last accepted step [J]
};

}  // namespace scree
