// SolverTrial: one solver, one recorded problem, and what came of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scree/ccp/ccp_file.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/simulation/part.hpp"

namespace scree {

class Executor;
class PluginCatalog;
class SceneTable;

/// Makes a solver from its settings, the keys of `table`.
/// @throws Error (usage) for an unknown solver or a setting that does not fit.
[[nodiscard]] Part<CcpSolver> make_solver(const PluginCatalog& catalog, const std::string& name,
                                          const SceneTable& table);

/// When to stop, and where to start.
struct TrialSettings {
  double tolerance = 1e-3;    ///< ccp_residual [m/s]
  int max_iterations = 1000;  ///< passes over all contacts
  bool warm = false;          ///< start from the recorded guess, not from zero
  bool coulomb = false;       ///< exact Coulomb friction, in place of the associated problem
};

/// What the command line says wins over what the scene of the record said. @throws Error (usage) for a tolerance below 0.
[[nodiscard]] TrialSettings trial_settings(const CcpOrigin& origin, std::optional<double> tolerance,
                                           std::optional<int> max_iterations);

/// Residual [m/s] after an iteration.
struct TrialPoint {
  int iteration = 0;
  double residual = 0.0;  ///< [m/s]
};

/// What a solve did, by core's own judge.
struct SolverTrial {
  std::string solver;
  bool warm = false;
  SolveSummary summary;             ///< iterations: of all problems that were solved
  int solves = 1;                   ///< problems solved, for exact friction or a matrix that is not symmetric
  CcpFigures figures;               ///< residual, violations and gap: of the friction that was asked for
  double wall_time = 0.0;           ///< of the solver alone [s]
  std::vector<TrialPoint> history;  ///< filled by trace_solver(); begins with the guess, iteration 0
  std::vector<double> answer;       ///< impulses [N s]
};

/// Solves `record` once, undisturbed.
[[nodiscard]] SolverTrial try_solver(const Part<CcpSolver>& solver, const CcpRecord& record,
                                     const TrialSettings& settings, const Executor& executor);

/// Solves it once more and fills in `trial.history`. Watching costs time, so that the wall time is not taken from here.
void trace_solver(const Part<CcpSolver>& solver, const CcpRecord& record, const TrialSettings& settings,
                  const Executor& executor, SolverTrial& trial);

}  // namespace scree
