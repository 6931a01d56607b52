// scree plugins [show KIND:NAME]: what is there, from which file, and what it takes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/config/describe_text.hpp"
#include "scree/config/suggest.hpp"
#include "scree/config/validate.hpp"
#include "scree/interfaces/narrow_phase.hpp"

namespace scree {
namespace {

struct PluginsOptions {
  std::vector<std::string> plugin_dirs;
  std::string name;  ///< kind:name of `show`
};

void list_plugins(const PluginHost& host) {
  std::size_t width = 0;
  for (const PluginEntry* entry : host.entries()) {
    width = std::max(width, entry->kind.size() + entry->name.size() + 1);
  }
  for (const PluginEntry* entry : host.entries()) {
    say("{:<{}}  {}\n{:<{}}  {} {}\n", entry->kind + ":" + entry->name, width, entry->help, "", width, entry->library,
        entry->version);
  }
  if (!host.entries().empty()) return;
  say("no plugins; searched in:\n");
  for (const auto& folder : host.searched()) say("  {}\n", folder.string());
}

/// ", for example KIND:NAME" with what `name` may have meant, whatever its kind is.
std::string example_of(const PluginHost& host, const std::string& name) {
  std::vector<std::string> names;
  for (const PluginEntry* entry : host.entries()) names.push_back(entry->name);
  const std::string nearest = nearest_word(name, names);
  for (const PluginEntry* entry : host.entries()) {
    if (nearest.empty() || entry->name == nearest) return ", for example " + entry->kind + ":" + entry->name;
  }
  return {};
}

/// The kinds that each kind meets, for a narrow phase that can be made without settings.
std::string supported_pairs(const PluginEntry& entry) {
  std::unique_ptr<Plugin> plugin;
  try {
    plugin = entry.make(default_options(entry.parameters));
  } catch (const std::exception&) {
    return {};  // it has settings without a default: what it supports depends on them
  }
  const auto* phase = dynamic_cast<const NarrowPhase*>(plugin.get());
  if (phase == nullptr) return {};
  std::string text = "\n  Supported pairs:\n";
  const auto add_line = [&](const char* name, const auto& meets) {
    std::string others;
    std::size_t count = 0;
    for (std::size_t b = 0; b < kShapeKindCount; ++b) {
      const auto kind = static_cast<ShapeKind>(b);
      if (!meets(kind)) continue;
      others += (others.empty() ? "" : ", ") + std::string{to_string(kind)};
      ++count;
    }
    if (count == 0) others = "-";
    if (count == kShapeKindCount) others = "all kinds";
    text += fmt::format("    {:<15} {}\n", name, others);
  };
  for (std::size_t a = 0; a < kShapeKindCount; ++a) {
    const auto kind = static_cast<ShapeKind>(a);
    add_line(to_string(kind), [&](ShapeKind other) { return phase->supports(kind, other); });
  }
  add_line("hollow cylinder", [&](ShapeKind inside) { return phase->supports_hollow(inside); });
  return text;
}

void show_plugin(const PluginHost& host, const std::string& name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos) {
    throw Error{ErrorKind::usage, "'" + name + "' names no plugin; write KIND:NAME" + example_of(host, name)};
  }
  const PluginEntry& entry = host.entry(name.substr(0, colon), name.substr(colon + 1), {});
  say("{}:{}\n  {}\n  from {} {}\n", entry.kind, entry.name, entry.help, entry.library, entry.version);
  const std::string parameters = describe_parameters(entry.parameters);
  say("\n{}", parameters.empty() ? "  It takes no settings.\n" : parameters);
  if (entry.kind == NarrowPhase::kKind) say("{}", supported_pairs(entry));
}

}  // namespace

void add_plugins_command(CLI::App& app, int& /*exit_code*/) {
  const auto options = std::make_shared<PluginsOptions>();
  CLI::App* plugins = app.add_subcommand("plugins", "List the plugins and the files they come from");
  plugins->add_option("--plugin-dir", options->plugin_dirs, "Look for plugins in this folder first (may be repeated)")
      ->type_name("DIR")
      ->allow_extra_args(false);
  CLI::App* show = plugins->add_subcommand("show", "Print the settings of one plugin: units, defaults, valid values");
  show->add_option("plugin", options->name, "The plugin, for example force_field:drag")
      ->required()
      ->type_name("KIND:NAME");
  show->fallthrough();
  plugins->final_callback([options, show] {
    const PluginHost host = find_general_plugins(options->plugin_dirs);
    if (show->parsed()) {
      show_plugin(host, options->name);
    } else {
      list_plugins(host);
    }
  });
}

}  // namespace scree
