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

#include "lanes_pass.hpp"
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
  void release_workspace() override;

 private:
  /// Sums over a pass of the contacts.
  struct Sums {
    double distance = 0.0;   ///< ||x_new - y||_D^2 [J]
    double uphill = 0.0;     ///< (y - x_new)^T D (x_new - x) [J]
    double linear = 0.0;     ///< r^T x_new [J]
    double curvature = 0.0;  ///< (x_new - y)^T N (x_new - y) [J]
    double quadratic = 0.0;  ///< x_new^T N x_new [J]
    Sums& operator+=(const Sums& o);
  };
  /// M^-1 of a body: columns of its inverse inertia [1/(kg m2)]; lane 3 of the first: inverse mass [1/kg].
  struct InverseMass {
    Lanes column[3];
    [[nodiscard]] apgd::Motion times(const apgd::Motion& p) const;
  };

  void prepare(const CcpProblem& problem, const SolveContext& context, std::span<const double> gamma);
  void prepare_group(std::size_t run_first, std::size_t run_last, std::size_t at, double mean,
                     std::span<const double> gamma);
  void start_objective();
  void spread_velocities(double beta);
  template <bool compliant>
  apgd::LaneSums contact_range(std::size_t first, std::size_t last, double beta);
  Sums contact_pass(double beta);
  Sums body_pass(double beta, double beta_next);
  bool descend(double beta, double beta_next, const SolveContext& context, SolveSummary& summary);
  void look(SolveSummary& summary, double start);
  double residual();
  double residual_range(std::size_t first, std::size_t last) const;
  /// Runs body(first contact, last contact, first group) for each run of contacts.
  template <class Body>
  void for_runs(const Body& body) const;
  void unpack(std::span<double> gamma) const;

  ApgdOptions options_;
  DelassusOperator delassus_;
  std::vector<apgd::Group> groups_;
  std::vector<Lanes3> compliance_;          ///< per group; empty without compliance
  std::vector<Lanes> scale_;                ///< 3 / trace(N_ii) [kg]; 0: no impulse changes anything
  std::vector<Lanes3> x_, x_old_, x_best_;  ///< impulses [N s], as groups_
  std::vector<Lanes3> x_new_;
  std::vector<InverseMass> inverse_mass_;
  std::vector<apgd::Motion> p_, p_old_, p_new_;        ///< sums per body [N s]
  std::vector<apgd::Motion> slot_sums_, slot_motion_;  ///< per slot: sums of x_new, velocities of y
  std::vector<Sums> partial_;
  std::vector<double> residual_partial_;
  double spread_ = -1.0;    ///< beta of the y whose velocities are in slot_motion_; below zero: of none
  double step_ = 1.0;       ///< t [1]
  double objective_ = 0.0;  ///< of x_ [J]
  double uphill_ = 0.0;     ///< of the last accepted step [J]
};

}  // namespace scree
