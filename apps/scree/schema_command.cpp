// scree schema: the JSON Schema of scenes, from the settings that core and the plugins describe.

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/config/schema.hpp"
#include "scree/simulation/scene_sections.hpp"

namespace scree {
namespace {

/// Plugins that a section can choose: those of the kind that it is named after.
std::vector<SchemaPlugin> plugins_of(const PluginHost& host, std::string_view kind) {
  std::vector<SchemaPlugin> plugins;
  for (const PluginEntry* entry : host.entries()) {
    if (entry->kind == kind) plugins.push_back({entry->name, entry->help, entry->parameters});
  }
  return plugins;
}

std::vector<SchemaSection> schema_sections(const PluginHost& host) {
  std::vector<SchemaSection> sections;
  for (const SceneSection& section : scene_sections()) {
    SchemaSection described;
    described.key = section.name;
    described.help = section.help;
    described.is_list = section.form == SectionForm::list || section.form == SectionForm::plugin_list;
    described.is_named = section.form == SectionForm::named;
    described.parameters = section.parameters;
    described.plugins = plugins_of(host, section.name);
    if (section.name == "shape") {  // core's own types choose the settings as plugins do
      for (const Variant& shape : shape_variants())
        described.plugins.push_back({shape.type, shape.help, shape.members});
    }
    sections.push_back(std::move(described));
  }
  return sections;
}

}  // namespace

void add_schema_command(CLI::App& app, int& /*exit_code*/) {
  const auto plugin_dirs = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of scenes, for editors");
  command->add_option("--plugin-dir", *plugin_dirs, "Look for plugins in this folder first (may be repeated)")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->final_callback([plugin_dirs] {
    const PluginHost host = find_general_plugins(*plugin_dirs);
    const std::vector<Parameter> root{
        Parameter::texts("plugins", "plugin files and folders, relative to the scene, searched first").optional()};
    say("{}\n", scene_schema(schema_sections(host), root));
  });
}

}  // namespace scree
