// PluginHost: finds, checks and loads plugin libraries, and answers core's questions by kind and name.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scree/host/plugin_file.hpp"

namespace scree {

/// All plugins of a program. Fill it with load() and search(), in order of precedence, before a scene is built; entries
/// stay valid as long as the host.
class PluginHost final : public PluginCatalog {
 public:
  /// Loads a file that somebody asked for by name. A file that is loaded already is left alone.
  /// @throws Error (usage), at `where`, when the file does not fit or holds a plugin that exists already.
  void load(const std::filesystem::path& file, const SourceLocation& where = {});
  /// Loads every file `*.so` of a folder, by name. Files that do not fit are left out and remembered in refused(), as
  /// they may have nothing to do with the scene. A folder that does not exist is remembered as searched.
  void search(const std::filesystem::path& folder);

  [[nodiscard]] const PluginEntry& entry(std::string_view kind, std::string_view name,
                                         const SourceLocation& where) const override;
  [[nodiscard]] std::vector<const PluginEntry*> entries() const override;

  /// Sentences on the files that search() left out: the file, and why.
  [[nodiscard]] const std::vector<std::string>& refused() const { return refused_; }
  /// Folders in the order searched.
  [[nodiscard]] const std::vector<std::filesystem::path>& searched() const { return searched_; }

 private:
  using Key = std::pair<std::string, std::string>;  // kind, name
  void add(PluginFile file);
  [[nodiscard]] std::vector<std::string> names_of(std::string_view kind) const;
  [[nodiscard]] std::string unknown(std::string_view kind, std::string_view name) const;

  std::map<Key, PluginEntry> entries_;
  std::vector<std::filesystem::path> loaded_;  // canonical
  std::vector<std::filesystem::path> searched_;
  std::vector<std::string> refused_;
};

}  // namespace scree
