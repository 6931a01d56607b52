// scree run SCENE.toml: from the arguments to a run.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <memory>
#include <thread>

#include "commands.hpp"
#include "run.hpp"
#include "scene_plugins.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/units.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

/// "5", "5 s", "200 ms" in seconds. @throws Error (usage).
double parse_end_time(const std::string& text) {
  if (text.empty()) throw Error{ErrorKind::usage, {"--end-time", 0, 0}, "'' is not a time, for example '5 s'"};
  try {
    // As in a scene, a plain number is in SI.
    double seconds = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), seconds);
    if (problem != std::errc{} || end != text.data() + text.size()) seconds = parse_quantity(text, "s");
    if (seconds > 0.0 && std::isfinite(seconds)) return seconds;
  } catch (const Error& problem) {
    throw Error{problem.kind(), {"--end-time", 0, 0}, problem.what()};
  }
  throw Error{ErrorKind::usage, {"--end-time", 0, 0}, "'" + text + "' is not above 0 s"};
}

/// NAME.scree-results in the working directory; NAME is the scene's file, or its folder for a scene.toml.
fs::path default_output(const fs::path& scene) {
  const fs::path absolute = fs::absolute(scene).lexically_normal();
  const fs::path name = absolute.filename() == "scene.toml" ? absolute.parent_path().filename() : absolute.stem();
  return name.string() + ".scree-results";
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  return fs::weakly_canonical(file).parent_path() == fs::weakly_canonical(folder);
}

void check_resume(const RunOptions& options) {
  if (options.resume.empty()) return;
  if (!fs::exists(options.resume)) {
    throw Error{ErrorKind::io, "there is no checkpoint file " + options.resume.string()};
  }
  if (options.overwrite && lies_in(options.resume, options.output)) {
    throw Error{ErrorKind::usage, "--overwrite would remove the checkpoint " + options.resume.string() +
                                      " before it is read; choose another folder with -o"};
  }
}

/// The simulation with its result folder. Older results are only removed for a scene that can run, and a scene that
/// cannot run leaves no folder behind.
std::unique_ptr<Simulation> make_simulation(const SceneDocument& scene, const PluginHost& host,
                                            const RunOptions& options) {
  SimulationSettings settings;
  settings.threads = options.threads;
  settings.end_time = options.end_time;
  const bool is_new = !fs::exists(options.output);
  if (!is_new && options.overwrite) Simulation{scene, host, settings};
  settings.results = ResultFolder::create(options.output, options.overwrite).path();
  try {
    auto simulation = std::make_unique<Simulation>(scene, host, settings);
    if (!options.resume.empty()) simulation->resume(options.resume);
    return simulation;
  } catch (...) {
    std::error_code ignored;
    if (is_new) fs::remove_all(options.output, ignored);
    throw;
  }
}

int run(RunOptions options) {
  options.scene = scene_file(options.scene);
  if (options.output.empty()) options.output = default_output(options.scene);
  if (options.threads == 0) options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  check_resume(options);
  const SceneDocument scene = SceneDocument::load(options.scene, options.overrides);
  const PluginHost host = find_scene_plugins(scene, options.plugin_dirs);
  const std::unique_ptr<Simulation> simulation = make_simulation(scene, host, options);
  return Run{*simulation, options}.to_the_end();
}

/// The option --end-time: given but empty is no end time.
CLI::Option* add_options(CLI::App& command, RunOptions& options, std::string& end_time) {
  command.add_option("scene", options.scene, "The scene")->required()->type_name("SCENE.toml");
  command.add_option("-o,--output", options.output, "Folder for the results [NAME.scree-results]")->type_name("DIR");
  command
      .add_option("--set", options.overrides, "Change a setting of the scene, for example simulation.end_time='2 s'")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--threads", options.threads, "Threads; the results do not depend on it [all cores]")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  CLI::Option* const end_time_option =
      command.add_option("--end-time", end_time, "Simulate until this time instead of the scene's")->type_name("T");
  command.add_option("--resume", options.resume, "Continue from a checkpoint of this scene")->type_name("FILE");
  command.add_flag("--overwrite", options.overwrite, "Replace the results of an older run in the folder");
  command.add_flag("--quiet", options.quiet, "No progress");
  command.add_flag("--profile", options.profile, "Print where the time went");
  command.add_option("--plugin-dir", options.plugin_dirs, "Look for plugins in this folder first (may be repeated)")
      ->type_name("DIR")
      ->allow_extra_args(false);
  return end_time_option;
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<RunOptions>();
  const auto end_time = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("run", "Run a scene and write its results into a folder");
  const CLI::Option* const end_time_option = add_options(*command, *options, *end_time);
  command->final_callback([options, end_time, end_time_option, &exit_code] {
    if (end_time_option->count() > 0) options->end_time = parse_end_time(*end_time);
    exit_code = run(*options);
  });
}

}  // namespace scree
