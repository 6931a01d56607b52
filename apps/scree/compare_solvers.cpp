// scree compare --vary ccp_solver=...: the contact problems of one run, given to several solvers.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "ccp_recording.hpp"
#include "compare_options.hpp"
#include "convergence.hpp"
#include "interrupt.hpp"
#include "run_statistics.hpp"
#include "run_to.hpp"
#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/ccp/count_contacts.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/suggest.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/simulation/simulation.hpp"
#include "solver_trial.hpp"

namespace scree {
namespace {

/// A solve shorter than this is repeated, for a wall time that means something [s].
constexpr double kShortSolve = 0.2;
constexpr int kRepeats = 4;

/// Refuses a --solver-set of a solver that does not take part.
void check_solver_settings(const CompareOptions& options) {
  for (const std::string& assignment : options.solver_settings) {
    const std::string solver = assignment.substr(0, assignment.find_first_of(".="));
    if (std::ranges::find(options.values, solver) != options.values.end()) continue;
    throw Error{ErrorKind::usage,
                {"--solver-set " + assignment, 0, 0},
                "'" + solver + "' is not one of the compared solvers, " + list_of(options.values) +
                    "; write for example " + options.values.front() + ".KEY=VALUE"};
  }
}

std::vector<Part<CcpSolver>> make_solvers(const CompareOptions& options, const PluginHost& host) {
  check_solver_settings(options);
  std::string tables;
  for (const std::string& name : options.values) tables += "['" + name + "']\n";
  const SceneDocument settings = SceneDocument::parse(tables, "--vary", options.solver_settings, "--solver-set");
  std::vector<Part<CcpSolver>> solvers;
  for (const std::string& name : options.values) {
    solvers.push_back(make_solver(host, name, settings.root().table(name)));
  }
  return solvers;
}

/// Runs the scene as far as needed and returns the records, in the order of time; nothing after an interrupt.
std::vector<CcpRecord> record_problems(const CompareOptions& options, const PluginHost& host,
                                       const SceneDocument& scene) {
  Simulation simulation{scene, host, {options.threads, {}, {}}};
  const std::vector<double> times = options.times.empty() ? std::vector{simulation.end_time()} : options.times;
  check_poses_problems(simulation, "--vary ccp_solver");
  const CcpRecording recording{simulation, times, options.output, "--at"};
  ResultFolder::create(options.output, options.overwrite);
  const bool done =
      run_to(simulation, *recording.steps().rbegin(), options.quiet, [&] { recording.before_step(simulation); }, {});
  std::vector<CcpRecord> records;
  if (!done) return records;
  for (const std::uint64_t step : recording.steps()) {
    if (!std::filesystem::exists(recording.file(step))) {
      throw Error{ErrorKind::usage,
                  {"--at", 0, 0},
                  fmt::format("step {} has no contacts and poses no contact problem; choose another time", step)};
    }
    records.push_back(read_ccp_file(recording.file(step)));
  }
  return records;
}

/// Every solver, cold and, where the run had a guess, warm.
std::vector<SolverTrial> try_solvers(const CompareOptions& options, const std::vector<Part<CcpSolver>>& solvers,
                                     const CcpRecord& record) {
  const Executor executor{options.threads};
  TrialSettings settings = trial_settings(record.origin, options.tolerance, options.max_iterations);
  const bool guessed = std::any_of(record.guess.begin(), record.guess.end(), [](double g) { return g != 0.0; });
  std::vector<SolverTrial> trials;
  for (const bool warm : {false, true}) {
    if (warm && !guessed) continue;
    settings.warm = warm;
    for (const Part<CcpSolver>& solver : solvers) {
      SolverTrial trial = try_solver(solver, record, settings, executor);
      for (int k = 0; k < kRepeats && trial.wall_time < kShortSolve; ++k) {
        const double again = try_solver(solver, record, settings, executor).wall_time;
        trial.wall_time = std::min(trial.wall_time, again);
      }
      trace_solver(solver, record, settings, executor, trial);
      trials.push_back(std::move(trial));
    }
  }
  return trials;
}

ReportTable table_of(const CcpRecord& record, const std::vector<SolverTrial>& trials) {
  const CcpProblem problem = record.problem();
  ReportTable table{
      fmt::format("step {} at {:.6g} s: {}, {}", record.origin.step, record.origin.time,
                  counted(problem.bodies(), "body", "bodies"), counted(count_contacts(problem), "contact", "contacts")),
      {"solver", "start", "status", "iterations", "residual [m/s]", "seconds", "ms/iteration"},
      {}};
  for (const SolverTrial& trial : trials) {
    table.rows.push_back({trial.solver, start_name(trial), std::string{to_string(trial.summary.status)},
                          std::to_string(trial.summary.iterations), fmt::format("{:.3e}", trial.figures.residual),
                          fmt::format("{:.4g}", trial.wall_time),
                          fmt::format("{:.4g}", 1e3 * seconds_per_iteration(trial))});
  }
  return table;
}

/// comparison.csv: one row a solve, its figures under the names that `scree solve` gives them.
class ComparisonLog {
 public:
  explicit ComparisonLog(const std::filesystem::path& file)
      : table_{file,
               {{"step", ""},
                {"time", "s"},
                {"bodies", ""},
                {"contacts", ""},
                {"solver", ""},
                {"start", ""},
                {"status", ""},
                {"iterations", ""},
                {"residual", "m/s"},
                {"relative_residual", "1"},
                {"coulomb_error", "1"},
                {"objective", "J"},
                {"cone_violation", "N s"},
                {"velocity_violation", "m/s"},
                {"complementarity_gap", "J"},
                {"wall_time", "s"},
                {"time_per_iteration", "s"}}} {}

  void add(const CcpRecord& record, const SolverTrial& trial) {
    table_.cell(record.origin.step).cell(record.origin.time);
    table_.cell(std::uint64_t{record.inverse_mass.size()}).cell(std::uint64_t{count_contacts(record.problem())});
    table_.cell(trial.solver).cell(start_name(trial)).cell(to_string(trial.summary.status));
    table_.cell(static_cast<std::int64_t>(trial.summary.iterations)).cell(trial.figures.residual);
    table_.cell(trial.figures.relative_residual).cell(trial.figures.coulomb_error).cell(trial.figures.objective);
    table_.cell(trial.figures.impulse_violation).cell(trial.figures.velocity_violation);
    table_.cell(trial.figures.complementarity_gap);
    table_.cell(trial.wall_time).cell(seconds_per_iteration(trial));
    table_.end_row();
  }
  void close() { table_.close(); }

 private:
  CsvWriter table_;
};

}  // namespace

int compare_solvers(const CompareOptions& options) {
  const SceneDocument scene = SceneDocument::load(options.scene, options.overrides_without_observers());
  const PluginHost host = find_scene_plugins(scene, options.plugin_dirs);
  const std::vector<Part<CcpSolver>> solvers = make_solvers(options, host);
  (void)trial_settings({}, options.tolerance, options.max_iterations);  // wrong use first
  const std::vector<CcpRecord> records = record_problems(options, host, scene);
  if (records.empty()) return kInterrupted;
  ComparisonLog log{options.output / "comparison.csv"};
  ConvergenceLog convergence{options.output / "convergence.csv"};
  for (const CcpRecord& record : records) {
    const std::vector<SolverTrial> trials = try_solvers(options, solvers, record);
    for (const SolverTrial& trial : trials) {
      log.add(record, trial);
      convergence.add(record, trial);
    }
    draw_convergence(record, trials, options.output);
    say("\n{}", to_text(table_of(record, trials)));
  }
  log.close();
  convergence.close();
  say("\ntables, plots and problems in {}\n", options.output.string());
  return 0;
}

}  // namespace scree
