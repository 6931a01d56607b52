// Semi-smooth Newton for cone complementarity problems: ProximalNewton from the guess, or from zero where that is lower.
#pragma once

#include <vector>

#include "proximal_newton.hpp"
#include "scree/ccp/direct/best_answer.hpp"
#include "scree/ccp/direct/direct_system.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree {

/// One factorisation an iteration; a good guess saves most of them.
class SemismoothNewton final : public CcpSolver {
 public:
  explicit SemismoothNewton(const second_order::PenaltyOptions& options) : options_{options} {}
  explicit SemismoothNewton(const Options& options);
  static std::vector<Parameter> parameters();

  SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) override;
  void release_workspace() override;

 private:
  second_order::PenaltyOptions options_;
  direct::DirectSystem system_;
  direct::BestAnswer best_;
  second_order::ProximalNewton newton_;
  std::vector<double> start_;  ///< impulses of the first iterate [N s]
};

}  // namespace scree
