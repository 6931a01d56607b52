// scree check SCENE.toml: everything but the run.

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "log_watch.hpp"
#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/model/body_store.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {
namespace {

struct CheckOptions {
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  std::vector<std::string> plugin_dirs;
  bool resolved = false;
};

void check(const CheckOptions& options) {
  const SceneDocument scene = SceneDocument::load(scene_file(options.scene), options.overrides);
  const PluginHost host = find_scene_plugins(scene, options.plugin_dirs);
  Simulation simulation{scene, host, {}};
  LogWatch log_watch;
  const auto tell_warnings = [&] {
    for (const std::string& sentence : log_watch.news(simulation.log())) warn(sentence);
  };
  const auto tell_untold = [&] {
    if (log_watch.untold() > 0) warn(fmt::format("{} more", log_watch.untold()));
  };
  tell_warnings();
  if (options.resolved) {
    tell_untold();
    say("{}\n", simulation.resolved_scene());
    return;
  }
  const std::size_t at_the_start = simulation.bodies().size();
  simulation.try_first_step();
  tell_warnings();
  tell_untold();
  say("{}: can run, {:.6g} s in steps of {:.6g} s; {} at the start\n", options.scene.string(), simulation.end_time(),
      simulation.time_step(), counted(at_the_start, "body", "bodies"));
  for (const PartInfo& part : simulation.parts()) say("  {}\n", part.label_with_library());
  for (const std::string& line : simulation.log()) say("  {}\n", line);
}

}  // namespace

void add_check_command(CLI::App& app, int& /*exit_code*/) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand("check", "Check a scene without running it");
  command->add_option("scene", options->scene, "The scene")->required()->type_name("SCENE.toml");
  command->add_option("--set", options->overrides, "Change a setting of the scene")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--plugin-dir", options->plugin_dirs, "Look for plugins in this folder first (may be repeated)")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->add_flag("--resolved", options->resolved, "Print the scene with every default filled in, as JSON");
  command->final_callback([options] { check(*options); });
}

}  // namespace scree
