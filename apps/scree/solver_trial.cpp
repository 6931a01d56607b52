#include "solver_trial.hpp"

#include <fmt/format.h>

#include <chrono>

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
  return {tolerance.value_or(origin.tolerance), max_iterations.value_or(origin.max_iterations), false};
}

SolverTrial try_solver(const Part<CcpSolver>& solver, const CcpRecord& record, const TrialSettings& settings,
                       const Executor& executor) {
  SolverTrial trial;
  trial.solver = solver.info.type;
  trial.warm = settings.warm;
  trial.answer = start_of(record, settings);
  const CcpProblem problem = record.problem();
  const SolveContext context = context_of(settings, executor);
  const auto start = std::chrono::steady_clock::now();
  trial.summary =
      guarded(solver.info, ErrorKind::diverged, [&] { return solver.plugin->solve(problem, context, trial.answer); });
  trial.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  trial.figures = CcpJudge{}.figures(problem, trial.answer, &executor);
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
