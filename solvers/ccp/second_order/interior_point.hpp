// Primal-dual interior point method for cone complementarity problems (Vandenberghe 2010, "The CVXOPT linear and quadratic
// cone program solvers"; Acary, Armand, Nguyen, Shpakovych 2023, "Second-order cone programming for frictional contact
// mechanics using interior point algorithm"), with Nesterov-Todd scaling and Mehrotra's predictor and corrector.
//
// Glossary: gamma, impulses [N s], always inside K; s = G gamma - b, the same as points of second-order cones; z, velocities
// in their duals [m/s]; W, scaling; u = N gamma + r [m/s].
//
//     u = G^T z,  s o z = mu e,  mu -> 0;      (N + E + G^T W^-2 G) d gamma = -(u - G^T z) + G^T W^-1 rho
#pragma once

#include <vector>

#include "barrier.hpp"
#include "proximal_newton.hpp"
#include "scree/ccp/direct/best_answer.hpp"
#include "scree/ccp/direct/direct_system.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "small_root.hpp"

namespace scree {

/// What a scene can say about interior_point.
struct InteriorPointOptions {
  double step_fraction = 0.99;   ///< part of the way to the boundary [1]
  double regularisation = 1e-9;  ///< proximal term in the Newton matrix, in units of each contact's N_ii [1]
};

/// One factorisation an iteration, two solves with refinement.
class InteriorPoint final : public CcpSolver {
 public:
  explicit InteriorPoint(const InteriorPointOptions& options) : options_{options} {}
  explicit InteriorPoint(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;
  void release_workspace() override;

 private:
  void prepare(const CcpProblem& problem, std::span<const double> gamma);
  void approach(const SolveContext& context, SolveSummary& summary);
  void start_inside();
  void gradient();
  bool advance(double step);
  second_order::SmallRoot root_of(std::size_t unit) const;
  bool factor();
  void add_barrier_product();
  void solve_newton();
  double step_length(double most) const;
  void set_target(bool corrector, double target);
  void make_directions();
  bool iterate();

  InteriorPointOptions options_;
  direct::DirectSystem system_;
  direct::BestAnswer best_;
  second_order::ProximalNewton newton_;
  second_order::Barrier barrier_;
  const CcpProblem* problem_ = nullptr;
  std::vector<double> weight_;                              ///< trace of each unit over its rows [1/kg]
  std::vector<double> gamma_, guess_, change_, candidate_;  ///< [N s]
  std::vector<double> u_, mismatch_;                        ///< N gamma + r, u - G^T z [m/s]
  std::vector<Vec3> l_, ds_, dz_, rho_;                     ///< per cone, scaled: W z = W^-1 s, W^-1 ds, W dz
  std::vector<second_order::Scaling> scaling_;
  std::vector<double> root_, c_;  ///< of E + G^T W^-2 G + regularisation, and of its inverse
  std::vector<double> rhs_, left_, correction_, state_;
  double regularisation_ = 0.0;
};

}  // namespace scree
