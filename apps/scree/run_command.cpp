// scree run SCENE.toml: from the arguments to a run.
#include <CLI/CLI.hpp>
#include <memory>
#include <thread>

#include "ccp_recording.hpp"
#include "commands.hpp"
#include "parse_time.hpp"
#include "run.hpp"
#include "scene_plugins.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

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
  const auto check_recording = [&](const Simulation& simulation) {
    CcpRecording{simulation, options.record_ccp, options.output, "--record-ccp"};
  };
  if (!is_new && options.overwrite) {
    const Simulation trial{scene, host, settings};
    if (options.resume.empty()) check_recording(trial);
  }
  settings.results = ResultFolder::create(options.output, options.overwrite).path();
  try {
    auto simulation = std::make_unique<Simulation>(scene, host, settings);
    if (!options.resume.empty()) simulation->resume(options.resume);
    check_recording(*simulation);
    return simulation;
  } catch (...) {
    std::error_code ignored;
    if (is_new) fs::remove_all(options.output, ignored);
    throw;
  }
}

int run(RunOptions options) {
  options.scene = scene_file(options.scene);
  if (options.output.empty()) options.output = default_output(options.scene, ".scree-results");
  if (options.threads == 0) options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  check_resume(options);
  const SceneDocument scene = SceneDocument::load(options.scene, options.overrides);
  const PluginHost host = find_scene_plugins(scene, options.plugin_dirs);
  const std::unique_ptr<Simulation> simulation = make_simulation(scene, host, options);
  return Run{*simulation, options}.to_the_end();
}

/// Words of the command line that are more than text.
struct RunWords {
  std::string end_time;
  std::vector<std::string> record_ccp;
};

/// The option --end-time: given but empty is no end time.
CLI::Option* add_options(CLI::App& command, RunOptions& options, RunWords& words) {
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
      command.add_option("--end-time", words.end_time, "Simulate until this time instead of the scene's")
          ->type_name("T");
  command.add_option("--resume", options.resume, "Continue from a checkpoint of this scene")->type_name("FILE");
  command
      .add_option("--record-ccp", words.record_ccp,
                  "Keep the contact problems of the steps at these times as ccp_STEP.h5")
      ->type_name("t=T,...")
      ->allow_extra_args(false);
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
  const auto words = std::make_shared<RunWords>();
  CLI::App* command = app.add_subcommand("run", "Run a scene and write its results into a folder");
  const CLI::Option* const end_time_option = add_options(*command, *options, *words);
  command->final_callback([options, words, end_time_option, &exit_code] {
    if (end_time_option->count() > 0) options->end_time = parse_time(words->end_time, "--end-time");
    options->record_ccp = parse_times(words->record_ccp, "--record-ccp");
    exit_code = run(*options);
  });
}

}  // namespace scree
