// Where plugins are looked for.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scree/host/plugin_host.hpp"

namespace scree {

/// A file or folder that somebody named, and where: `plugins = [...]` of a scene or `--plugin-dir`.
struct NamedPlace {
  std::filesystem::path path;  ///< absolute, or relative to the working directory
  SourceLocation where;
};

/// Loads plugins in order of precedence: the files and folders that the scene names, those of the command line, the
/// folders of the environment variable SCREE_PLUGIN_PATH (separated by colons), and default_plugin_folder(). Never the
/// working directory by itself.
/// @throws Error (usage) when a named place does not exist or a named file does not fit.
void find_plugins(PluginHost& host, std::span<const NamedPlace> of_scene, std::span<const NamedPlace> of_command_line);

/// The folder scree/plugins beside libscree, in the build tree and where it is installed; empty when that cannot be
/// found out.
[[nodiscard]] std::filesystem::path default_plugin_folder();

/// The folders in the environment variable SCREE_PLUGIN_PATH.
[[nodiscard]] std::vector<std::filesystem::path> environment_plugin_folders();

}  // namespace scree
