// scree solve PROBLEM: one contact problem, recorded or of FCLIB, one solver.

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "commands.hpp"
#include "problem_file.hpp"
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
  std::string friction = "associated";
  std::filesystem::path output;  ///< empty: the answer is not kept
  bool warm = false;
  bool json = false;
};

void print_json(const SolverTrial& trial, const SolveOptions& options) {
  const nlohmann::ordered_json out{{"solver", trial.solver},
                                   {"status", to_string(trial.summary.status)},
                                   {"iterations", trial.summary.iterations},
                                   {"residual", trial.figures.residual},
                                   {"relative_residual", trial.figures.relative_residual},
                                   {"coulomb_error", trial.figures.coulomb_error},
                                   {"objective", trial.figures.objective},
                                   {"wall_time", trial.wall_time},
                                   {"cone_violation", trial.figures.impulse_violation},
                                   {"velocity_violation", trial.figures.velocity_violation},
                                   {"complementarity_gap", trial.figures.complementarity_gap},
                                   {"friction", options.friction},
                                   {"solves", trial.solves}};
  say("{}\n", out.dump(2));
}

void print_text(const SolverTrial& trial, const SolveOptions& options) {
  say("solver               {}\n", trial.solver);
  say("friction             {}\n", options.friction);
  say("status               {}\n", to_string(trial.summary.status));
  say("iterations           {}\n", trial.summary.iterations);
  say("solves               {}\n", trial.solves);
  say("residual             {:.6g} m/s\n", trial.figures.residual);
  say("relative_residual    {:.6g}\n", trial.figures.relative_residual);
  say("coulomb_error        {:.6g}\n", trial.figures.coulomb_error);
  say("objective            {:.9g} J\n", trial.figures.objective);
  say("cone_violation       {:.6g} N s\n", trial.figures.impulse_violation);
  say("velocity_violation   {:.6g} m/s\n", trial.figures.velocity_violation);
  say("complementarity_gap  {:.6g} J\n", trial.figures.complementarity_gap);
  say("wall_time            {:.6g} s\n", trial.wall_time);
}

void solve(const SolveOptions& options) {
  const PluginHost host = find_general_plugins(options.plugin_dirs);
  const SceneDocument settings = SceneDocument::parse("", "the settings of the solver", options.settings);
  const Part<CcpSolver> solver = make_solver(host, options.solver, settings.root());
  (void)trial_settings({}, options.tolerance, options.max_iterations);  // wrong use first
  const ProblemFile problem{options.problem};
  if (!options.output.empty()) problem.check_solution_file(options.output);
  const Executor executor{options.threads > 0 ? options.threads
                                              : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))};
  TrialSettings wanted = trial_settings(problem.record().origin, options.tolerance, options.max_iterations);
  wanted.warm = options.warm;
  wanted.coulomb = options.friction == "coulomb";
  const SolverTrial trial = try_solver(solver, problem.record(), wanted, executor);
  if (!options.output.empty()) problem.write_solution(options.output, trial.answer);
  if (options.json) {
    print_json(trial, options);
  } else {
    say("{}\n", problem.headline());
    print_text(trial, options);
  }
}

}  // namespace

void add_solve_command(CLI::App& app, int& /*exit_code*/) {
  const auto options = std::make_shared<SolveOptions>();
  CLI::App* command =
      app.add_subcommand("solve", "Solve a contact problem that `run --record-ccp` kept, or one of FCLIB");
  command->add_option("problem", options->problem, "The problem: a file of scree or of the Frictional Contact Library")
      ->required()
      ->type_name("PROBLEM");
  command->add_option("--solver", options->solver, "The solver; `scree plugins` lists them as ccp_solver:NAME")
      ->required()
      ->type_name("NAME");
  command->add_option("--set", options->settings, "Change a setting of the solver, for example relaxation=1.2")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--tolerance", options->tolerance, "Stop at this residual, in m/s [as in the scene; FCLIB: 1e-8]")
      ->type_name("X");
  command
      ->add_option("--max-iterations", options->max_iterations,
                   "Stop after so many iterations [as in the scene; FCLIB: 100000]")
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("N");
  command->add_option("--threads", options->threads, "Threads; the answer does not depend on it [all cores]")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  command->add_option("--friction", options->friction, "associated (convex) or coulomb (exact) [associated]")
      ->check(CLI::IsMember({"associated", "coulomb"}))
      ->type_name("MODEL");
  command->add_flag("--warm", options->warm, "Start from the recorded guess, not from zero");
  command->add_option("-o,--output", options->output, "Write the problem and its answer to this file, as FCLIB does")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print the figures as JSON");
  command->add_option("--plugin-dir", options->plugin_dirs, "Look for plugins in this folder first (may be repeated)")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->final_callback([options] { solve(*options); });
}

}  // namespace scree
