// The plugins that a command works with, and how it tells the user about files that were left out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scree/host/plugin_host.hpp"

namespace scree {

class SceneDocument;

/// The scene file that a user means: a folder stands for the scene.toml in it.
[[nodiscard]] std::filesystem::path scene_file(const std::filesystem::path& scene);

/// NAME with `ending` in the working directory; NAME is the scene's file, or its folder for a scene.toml.
[[nodiscard]] std::filesystem::path default_output(const std::filesystem::path& scene, const std::string& ending);

/// The plugins of the folders in `plugin_dirs`, of SCREE_PLUGIN_PATH and of scree itself. Prints a warning for every
/// file that was left out. @throws Error (usage) for a folder that does not exist.
[[nodiscard]] PluginHost find_general_plugins(const std::vector<std::string>& plugin_dirs);

/// The same, after those that the scene names in `plugins = [...]`, relative to the file that says so.
[[nodiscard]] PluginHost find_scene_plugins(const SceneDocument& scene, const std::vector<std::string>& plugin_dirs);

}  // namespace scree
