#include "scene_plugins.hpp"

#include <cstdio>

#include "say.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/validate.hpp"
#include "scree/host/search_path.hpp"

namespace scree {
namespace {

/// The entries of the scene's `plugins = [...]`.
std::vector<NamedPlace> places_of_scene(const SceneDocument& scene) {
  const std::vector<std::string> keys = scene.root().keys();
  std::vector<std::string_view> others;
  for (const std::string& key : keys) {
    if (key != "plugins") others.emplace_back(key);
  }
  const Options options = validate(scene.root().without(others), {Parameter::texts("plugins", "").optional()}, "scene");
  std::vector<NamedPlace> places;
  if (!options.has("plugins")) return places;
  const SourceLocation where = options.location("plugins");
  for (const std::string& text : options.texts("plugins")) {
    places.push_back({std::filesystem::path{where.file}.parent_path() / text, where});
  }
  return places;
}

std::vector<NamedPlace> places_of_command_line(const std::vector<std::string>& folders) {
  std::vector<NamedPlace> places;
  for (const std::string& folder : folders) places.push_back({folder, {"--plugin-dir", 0, 0}});
  return places;
}

PluginHost find(const std::vector<NamedPlace>& of_scene, const std::vector<std::string>& plugin_dirs) {
  PluginHost host;
  find_plugins(host, of_scene, places_of_command_line(plugin_dirs));
  for (const std::string& sentence : host.refused()) warn(sentence);
  return host;
}

}  // namespace

std::filesystem::path scene_file(const std::filesystem::path& scene) {
  return std::filesystem::is_directory(scene) ? scene / "scene.toml" : scene;
}

std::filesystem::path default_output(const std::filesystem::path& scene, const std::string& ending) {
  const std::filesystem::path absolute = std::filesystem::absolute(scene).lexically_normal();
  const bool is_folder = absolute.filename() == "scene.toml";
  const std::filesystem::path name = is_folder ? absolute.parent_path().filename() : absolute.stem();
  return name.string() + ending;
}

PluginHost find_general_plugins(const std::vector<std::string>& plugin_dirs) { return find({}, plugin_dirs); }

PluginHost find_scene_plugins(const SceneDocument& scene, const std::vector<std::string>& plugin_dirs) {
  return find(places_of_scene(scene), plugin_dirs);
}

}  // namespace scree
