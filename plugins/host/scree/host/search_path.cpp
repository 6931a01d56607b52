#include "scree/host/search_path.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <sstream>

namespace scree {
namespace {

void find_named(PluginHost& host, std::span<const NamedPlace> places) {
  for (const NamedPlace& place : places) {
    if (std::filesystem::is_directory(place.path)) {
      host.search(place.path);
    } else if (std::filesystem::exists(place.path)) {
      host.load(place.path, place.where);
    } else {
      throw Error{
          ErrorKind::usage, place.where,
          "there is no plugin file or folder " + std::filesystem::absolute(place.path).lexically_normal().string()};
    }
  }
}

}  // namespace

void find_plugins(PluginHost& host, std::span<const NamedPlace> of_scene, std::span<const NamedPlace> of_command_line) {
  find_named(host, of_scene);
  find_named(host, of_command_line);
  for (const auto& folder : environment_plugin_folders()) host.search(folder);
  // An empty path would stand for the working directory.
  if (const auto folder = default_plugin_folder(); !folder.empty()) host.search(folder);
}

std::filesystem::path default_plugin_folder() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&to_prefix), &library) == 0) return {};
  std::error_code failure;
  const std::filesystem::path file = std::filesystem::canonical(library.dli_fname, failure);
  if (failure) return {};
  return file.parent_path() / "scree" / "plugins";
}

std::vector<std::filesystem::path> environment_plugin_folders() {
  std::vector<std::filesystem::path> folders;
  const char* variable = std::getenv("SCREE_PLUGIN_PATH");
  std::istringstream text{variable != nullptr ? variable : ""};
  for (std::string folder; std::getline(text, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

}  // namespace scree
