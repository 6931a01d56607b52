// PluginFile: one shared library, opened, checked and asked for its plugins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scree/interfaces/plugin_library.hpp"

namespace scree {

/// A plugin library that passed every check. It stays loaded until the program ends: a stray pointer into an unloaded
/// library would be worse than the memory.
struct PluginFile {
  std::filesystem::path file;        ///< absolute
  std::string name;                  ///< of the library
  std::string version;               ///< of the library
  std::vector<PluginEntry> entries;  ///< in the order of the library's list
};

/// Opens `file` and checks, in this order: it is a shared library whose symbols are all there; it exports
/// scree_plugin_library; its ABI number; its build fingerprint; its entries. Nothing of the library is called before
/// ABI number and fingerprint agree. What throws while one of the entries is made arrives as an Error that names the
/// plugin and the file.
/// @throws Error (usage) with the file, what does not fit (both sides of a mismatch), and what to do.
[[nodiscard]] PluginFile open_plugin_file(const std::filesystem::path& file);

/// "kind:name (file.so)", as messages name a plugin.
[[nodiscard]] std::string to_string(const PluginEntry& entry);

}  // namespace scree
