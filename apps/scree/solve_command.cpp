// scree solve PROBLEM.h5: one recorded contact problem, one solver.

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "commands.hpp"
#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/parallel/executor.hpp"
#include "solver_trial.hpp"

namespace scree {
namespace {

struct SolveOptions {
  std::filesystem::path problem;
  std::string solver;
  std::vector<std::string> settings;  ///< "key=value" of the solver
  std::vector<std::string> plugin_dirs;
  std::optional<double> tolerance;  ///< [m/s]
  std::optional<int> max_iterations;
  int threads = 0;  ///< 0: as many as the machine has
  bool warm = false;
  bool json = false;
};

void print_json(const SolverTrial& trial) {
  const nlohmann::ordered_json out{{"solver", trial.solver},
                                   {"status", to_string(trial.summary.status)},
                                   {"iterations", trial.summary.iterations},
                                   {"residual", trial.figures.residual},
                                   {"relative_residual", trial.figures.relative_residual},
                                   {"coulomb_error", trial.figures.coulomb_error},
                                   {"objective", trial.figures.objective},
                                   {"wall_time", trial.wall_time}};
  say("{}\n", out.dump(2));
}

void print_text(const SolverTrial& trial) {
  say("solver             {}\n", trial.solver);
  say("status             {}\n", to_string(trial.summary.status));
  say("iterations         {}\n", trial.summary.iterations);
  say("residual           {:.6g} m/s\n", trial.figures.residual);
  say("relative_residual  {:.6g}\n", trial.figures.relative_residual);
  say("coulomb_error      {:.6g}\n", trial.figures.coulomb_error);
  say("objective          {:.9g} J\n", trial.figures.objective);
  say("wall_time          {:.6g} s\n", trial.wall_time);
}

void solve(const SolveOptions& options) {
  const PluginHost host = find_general_plugins(options.plugin_dirs);
  const SceneDocument settings = SceneDocument::parse("", "the settings of the solver", options.settings);
  const Part<CcpSolver> solver = make_solver(host, options.solver, settings.root());
  (void)trial_settings({}, options.tolerance, options.max_iterations);  // wrong use first
  const CcpRecord record = read_ccp_file(options.problem);
  const Executor executor{options.threads > 0 ? options.threads
                                              : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))};
  TrialSettings wanted = trial_settings(record.origin, options.tolerance, options.max_iterations);
  wanted.warm = options.warm;
  const SolverTrial trial = try_solver(solver, record, wanted, executor);
  if (options.json) {
    print_json(trial);
  } else {
    say("{} bodies, {} contacts, step {} at {:.6g} s\n", record.inverse_mass.size(), record.contacts.size(),
        record.origin.step, record.origin.time);
    print_text(trial);
  }
}

}  // namespace

void add_solve_command(CLI::App& app, int& /*exit_code*/) {
  const auto options = std::make_shared<SolveOptions>();
  CLI::App* command = app.add_subcommand("solve", "Solve a contact problem that `run --record-ccp` kept");
  command->add_option("problem", options->problem, "The problem")->required()->type_name("PROBLEM.h5");
  command->add_option("--solver", options->solver, "The solver; `scree plugins` lists them as ccp_solver:NAME")
      ->required()
      ->type_name("NAME");
  command->add_option("--set", options->settings, "Change a setting of the solver, for example relaxation=1.2")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--tolerance", options->tolerance, "Stop at this residual, in m/s [as in the scene]")
      ->type_name("X");
  command->add_option("--max-iterations", options->max_iterations, "Stop after so many iterations [as in the scene]")
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("N");
  command->add_option("--threads", options->threads, "Threads; the answer does not depend on it [all cores]")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  command->add_flag("--warm", options->warm, "Start from the impulses that the run started from, not from zero");
  command->add_flag("--json", options->json, "Print the figures as JSON");
  command->add_option("--plugin-dir", options->plugin_dirs, "Look for plugins in this folder first (may be repeated)")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->final_callback([options] { solve(*options); });
}

}  // namespace scree
