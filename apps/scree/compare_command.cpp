// scree compare SCENE.toml --vary WHAT=A,B,C: the same scene with one thing exchanged.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>

#include "commands.hpp"
#include "compare_options.hpp"
#include "parse_time.hpp"
#include "scene_plugins.hpp"
#include "scree/base/error.hpp"

namespace scree {
namespace {

Error vary_error(const std::string& sentence) { return Error{ErrorKind::usage, {"--vary", 0, 0}, sentence}; }

/// "ccp_solver=pgs,apgd" into its words.
void parse_vary(const std::string& text, CompareOptions& options) {
  options.values.clear();
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw vary_error("'" + text + "' does not say what to exchange for what; write for example ccp_solver=pgs,apgd");
  }
  options.vary = text.substr(0, equals);
  std::string rest = text.substr(equals + 1);
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string value = rest.substr(0, comma);
    if (value.empty()) throw vary_error("'" + text + "' has an empty value; write for example ccp_solver=pgs,apgd");
    if (std::find(options.values.begin(), options.values.end(), value) != options.values.end()) {
      throw vary_error("'" + value + "' stands there twice");
    }
    options.values.push_back(value);
    if (comma == std::string::npos) return;
    rest.erase(0, comma + 1);
  }
}

/// Words of the command line that are more than text.
struct CompareWords {
  std::vector<std::string> vary;
  std::vector<std::string> at;
};

/// All words of --vary. Collision phases may stand side by side; anything else stands alone.
void parse_all_vary(const std::vector<std::string>& words, CompareOptions& options) {
  for (const std::string& text : words) {
    parse_vary(text, options);
    if (options.vary == "broad_phase") options.broad_phases = options.values;
    if (options.vary == "narrow_phase") options.narrow_phases = options.values;
    const bool phases = options.vary == "broad_phase" || options.vary == "narrow_phase";
    if (!phases && words.size() > 1) {
      throw vary_error("only broad_phase and narrow_phase can be varied together; give '" + text + "' alone");
    }
  }
}

int compare(CompareOptions options, const CompareWords& words) {
  parse_all_vary(words.vary, options);
  options.times = parse_times(words.at, "--at");
  options.scene = scene_file(options.scene);
  if (options.output.empty()) options.output = default_output(options.scene, ".scree-comparison");
  if (options.threads == 0) options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (options.vary == "ccp_solver") return compare_solvers(options);
  if (!options.solver_settings.empty() || options.tolerance || options.max_iterations) {
    throw vary_error("--solver-set, --tolerance and --max-iterations go with --vary ccp_solver=...; use --set for '" +
                     options.vary + "'");
  }
  if (!options.broad_phases.empty() || !options.narrow_phases.empty()) return compare_phases(options);
  return compare_runs(options);
}

void add_options(CLI::App& command, CompareOptions& options, CompareWords& words) {
  command.add_option("scene", options.scene, "The scene")->required()->type_name("SCENE.toml");
  command
      .add_option("--vary", words.vary,
                  "What to exchange: ccp_solver=pgs,apgd gives one problem to several solvers; broad_phase=A,B and "
                  "narrow_phase=A+B,C (a chain, or several) give the bodies of one moment to collision phases; a "
                  "setting such as simulation.time_step=A,B runs the scene for each")
      ->required()
      ->allow_extra_args(false)
      ->type_name("WHAT=A,B");
  command.add_option("--at", words.at, "Compare at these times [the scene's end]")
      ->type_name("T,...")
      ->allow_extra_args(false);
  command.add_option("-o,--output", options.output, "Folder for the results [NAME.scree-comparison]")->type_name("DIR");
  command.add_option("--set", options.overrides, "Change a setting of the scene")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--solver-set", options.solver_settings,
                  "Change a setting of a compared solver, for example pgs.relaxation=1.2")
      ->type_name("SOLVER.KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--tolerance", options.tolerance, "Solvers stop at this residual, in m/s [as in the scene]")
      ->type_name("X");
  command
      .add_option("--max-iterations", options.max_iterations, "Solvers stop after so many iterations [as in the scene]")
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("N");
  command.add_option("--threads", options.threads, "Threads; the answers do not depend on it [all cores]")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  command.add_flag("--overwrite", options.overwrite, "Replace the results of an older comparison in the folder");
  command.add_flag("--quiet", options.quiet, "No progress");
  command.add_option("--plugin-dir", options.plugin_dirs, "Look for plugins in this folder first (may be repeated)")
      ->type_name("DIR")
      ->allow_extra_args(false);
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CompareOptions>();
  const auto words = std::make_shared<CompareWords>();
  options->threads = 0;
  CLI::App* command =
      app.add_subcommand("compare", "Compare solvers or collision phases on the same state, or whole runs");
  add_options(*command, *options, *words);
  command->final_callback([options, words, &exit_code] { exit_code = compare(*options, *words); });
}

}  // namespace scree
