#include "solver_trial.hpp"

#include <fmt/format.h>

#include <chrono>

#include "scree/ccp/coulomb.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/validate.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

std::vector<double> start_of(const CcpRecord& record, const TrialSettings& settings) {
  return settings.warm ? record.guess : std::vector<double>(record.guess.size(), 0.0);
}

SolveContext context_of(const TrialSettings& settings, const Executor& executor) {
  SolveContext context;
  context.tolerance = settings.tolerance;
  context.max_iterations = settings.max_iterations;
  context.executor = &executor;
  return context;
}

/// CCPs solved at most for one problem; mostly a few dozen are needed.
constexpr int kMaxSolves = 1000;

/// What the solver by itself does not do: exact friction, a matrix that is not symmetric.
SolveSummary solve_over(CcpSolver& solver, const CcpProblem& problem, const TrialSettings& settings,
                        const Executor& executor, SolverTrial& trial) {
  const InnerSolve inner = [&](const CcpProblem& posed, const InnerGoal& goal, std::span<double> gamma) {
    return solver.solve(
        posed, context_of({.tolerance = goal.tolerance, .max_iterations = goal.max_iterations}, executor), gamma);
  };
  const CoulombLimits limits{.tolerance = settings.tolerance,
                             .max_solves = kMaxSolves,
                             .max_iterations = settings.max_iterations,
                             .coulomb = settings.coulomb};
  const CoulombSummary outer = CoulombIteration{}.solve(problem, executor, inner, limits, trial.answer);
  trial.solves = outer.solves;
  return outer.solve;
}

/// The judge's figures; residual, violations and gap are those of the friction that was asked for.
CcpFigures figures_of(const CcpProblem& problem, std::span<const double> gamma, bool coulomb,
                      const Executor& executor) {
  CcpJudge judge;
  CcpFigures figures = judge.figures(problem, gamma, &executor);
  if (!coulomb) return figures;
  CcpProblem exact = problem;
  const std::vector<double> r = exact_r(problem, gamma, &executor);
  exact.r = r;
  const CcpFigures of_exact = judge.figures(exact, gamma, &executor);
  figures.residual = of_exact.residual;
  figures.velocity_violation = of_exact.velocity_violation;
  figures.complementarity_gap = of_exact.complementarity_gap;
  return figures;
}

}  // namespace

Part<CcpSolver> make_solver(const PluginCatalog& catalog, const std::string& name, const SceneTable& table) {
  const PluginEntry& entry = catalog.entry(CcpSolver::kKind, name, {});
  Part<CcpSolver> part;
  part.info = {CcpSolver::kKind, name, name, entry.library, entry.version};
  part.options = validate(table, entry.parameters, part.info.label());
  part.options.set_type(name);
  std::unique_ptr<Plugin> plugin = guarded(part.info, ErrorKind::usage, [&] { return entry.make(part.options); });
  part.plugin.reset(dynamic_cast<CcpSolver*>(plugin.get()));
  if (part.plugin == nullptr) throw Error{ErrorKind::usage, part.info.label_with_library() + " is not a ccp_solver"};
  static_cast<void>(plugin.release());
  return part;
}

TrialSettings trial_settings(const CcpOrigin& origin, std::optional<double> tolerance,
                             std::optional<int> max_iterations) {
  if (tolerance && !(*tolerance >= 0.0)) {
    throw Error{ErrorKind::usage,
                {"--tolerance", 0, 0},
                fmt::format("a residual in m/s is needed, from 0 on; got {:g}", *tolerance)};
  }
  return {.tolerance = tolerance.value_or(origin.tolerance),
          .max_iterations = max_iterations.value_or(origin.max_iterations)};
}

SolverTrial try_solver(const Part<CcpSolver>& solver, const CcpRecord& record, const TrialSettings& settings,
                       const Executor& executor) {
  SolverTrial trial;
  trial.solver = solver.info.type;
  trial.warm = settings.warm;
  trial.answer = start_of(record, settings);
  const CcpProblem problem = record.problem();
  const SolveContext context = context_of(settings, executor);
  const bool alone = !settings.coulomb && problem.matrix.empty();
  const auto start = std::chrono::steady_clock::now();
  trial.summary = guarded(solver.info, ErrorKind::diverged, [&] {
    return alone ? solver.plugin->solve(problem, context, trial.answer)
                 : solve_over(*solver.plugin, problem, settings, executor, trial);
  });
  trial.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  trial.figures = figures_of(problem, trial.answer, settings.coulomb, executor);
  return trial;
}

void trace_solver(const Part<CcpSolver>& solver, const CcpRecord& record, const TrialSettings& settings,
                  const Executor& executor, SolverTrial& trial) {
  std::vector<double> gamma = start_of(record, settings);
  const CcpProblem problem = record.problem();
  trial.history = {{0, ccp_residual(problem, gamma, &executor)}};
  SolveContext context = context_of(settings, executor);
  context.on_iteration = [&](const IterationReport& report) {
    if (report.residual >= 0.0) trial.history.push_back({report.iteration, report.residual});
  };
  guarded(solver.info, ErrorKind::diverged, [&] { return solver.plugin->solve(problem, context, gamma); });
}

}  // namespace scree
