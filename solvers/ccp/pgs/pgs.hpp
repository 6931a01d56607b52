// Block projected Gauss-Seidel for cone complementarity problems (Tasora &
// Anitescu 2010, 2011): contact after contact, each with the velocities that the
// ones before it left.
#pragma once

#include <vector>

#include "colouring.hpp"
#include "grouping.hpp"
#include "scree/ccp/delassus.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "sweep.hpp"

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

 private:
  bool prepare(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma);
  void prepare_bodies(const CcpProblem& problem);
  void prepare_groups(const CcpProblem& problem, std::span<const double> gamma);
  void sweep(const SolveContext& context);
  template <bool isotropic, bool compliant>
  void sweep_groups(std::size_t first, std::size_t last);
  double residual(std::span<double> gamma);

  PgsOptions options_;
  DelassusOperator delassus_;
  pgs::Colouring colouring_;
  std::vector<pgs::Body> bodies_;
  std::vector<pgs::Inertia> inertias_;  ///< empty when all bodies are isotropic
  pgs::Grouping grouping_;
  std::vector<pgs::Group> groups_;  ///< as in grouping_
  std::vector<Lanes3> compliance_;  ///< per group; empty without compliance
  std::vector<Twist> w_;
  std::vector<double> partial_;
  std::vector<double> guess_;
};

}  // namespace scree
