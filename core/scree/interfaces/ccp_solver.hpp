// CcpSolver: solves one cone complementarity problem.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "scree/ccp/problem.hpp"
#include "scree/interfaces/plugin.hpp"

namespace scree {

class Executor;

/// How a solve ended.
enum class SolveStatus { converged, iteration_limit, stalled, infeasible, numerical_failure };

[[nodiscard]] std::string_view to_string(SolveStatus status);

/// What a solver knows after an iteration; `residual` is negative when it was
/// not computed in this one.
struct IterationReport {
  int iteration = 0;
  double residual = -1.0;  ///< ccp_residual [m/s]
};

/// When to stop, and what to work with. Never wall time: results must not
/// depend on the machine.
struct SolveContext {
  double tolerance = 1e-3;   ///< stop at this ccp_residual [m/s]
  int max_iterations = 100;  ///< stop after so many passes over all contacts and blocks
  const Executor* executor = nullptr;
  std::function<void(const IterationReport&)> on_iteration;  ///< may be empty
};

/// What a solve did.
struct SolveSummary {
  SolveStatus status = SolveStatus::converged;
  int iterations = 0;
  double residual = 0.0;  ///< ccp_residual of the answer, by the one judge [m/s]
};

/// A method for CCPs. It may keep workspace, but no information, between calls,
/// unless save() writes it.
class CcpSolver : public Plugin {
 public:
  static constexpr const char* kKind = "ccp_solver";
  ~CcpSolver() override;

  /// Solves `problem`. `gamma` (problem.rows() numbers) [N s] holds the first
  /// guess, any finite numbers, and receives the answer, which lies in K to
  /// rounding and is never worse in the objective than the projected guess.
  /// Contacts, blocks of every kind and an explicit matrix: @throws
  /// std::logic_error for what the method cannot take, and its README says so.
  virtual SolveSummary solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) = 0;
};

}  // namespace scree
