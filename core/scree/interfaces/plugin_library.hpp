// What a plugin library exports: one symbol, constant data, which the host reads before it calls anything.
//
//     namespace {
//     void list(scree::PluginList& plugins) {
//       plugins.add<scree::ForceField, Wind>(
//           "wind", "A uniform push.", {scree::Parameter::vector("push", "m/s2", "acceleration of all bodies")});
//     }
//     }  // namespace
//     extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
//         scree::describe_library("wind", "1.0.0", &list)};
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/interfaces/build_fingerprint.hpp"
#include "scree/interfaces/plugin.hpp"

#define SCREE_EXPORT __attribute__((visibility("default")))

namespace scree {

/// Raised whenever an interface of a plugin changes.
inline constexpr std::uint32_t kPluginAbi = 5;

/// One plugin of a library: its name and how to make one.
struct PluginEntry {
  std::string kind;  ///< "force_field", "ccp_solver", ...
  std::string name;  ///< lower_snake, unique within its kind
  std::string help;  ///< one line
  std::vector<Parameter> parameters;
  std::function<std::unique_ptr<Plugin>(const Options&)> make;
  std::string library;  ///< file it came from; filled in by the host
  std::string version;  ///< of the library; filled in by the host
  /// Of a narrow phase: its place in the chain of a scene that names none, the lowest first; 0 keeps it out of that chain.
  int default_place = 0;
};

/// Collects the entries of a library.
class PluginList {
 public:
  /// Adds `Type`, an `Interface`, which is constructed from const Options& (or
  /// from nothing), and returns its entry, valid until the next call.
  template <class Interface, class Type>
  PluginEntry& add(std::string name, std::string help, std::vector<Parameter> parameters = {}) {
    static_assert(std::is_base_of_v<Interface, Type>, "the plugin must derive from the interface that it is added as");
    entries_.push_back({Interface::kKind,
                        std::move(name),
                        std::move(help),
                        std::move(parameters),
                        [](const Options& options) -> std::unique_ptr<Plugin> {
                          if constexpr (std::is_constructible_v<Type, const Options&>) {
                            return std::make_unique<Type>(options);
                          } else {
                            return std::make_unique<Type>();
                          }
                        },
                        {},
                        {},
                        0});
    return entries_.back();
  }
  [[nodiscard]] const std::vector<PluginEntry>& entries() const { return entries_; }

 private:
  std::vector<PluginEntry> entries_;
};

/// The exported symbol `scree_plugin_library`. Plain data: reading it runs no
/// code of the plugin.
struct PluginLibrary {
  std::uint32_t abi;
  BuildFingerprint fingerprint;
  const char* name;
  const char* version;
  void (*list)(PluginList&);
};

/// The PluginLibrary of the code being compiled.
constexpr PluginLibrary describe_library(const char* name, const char* version, void (*list)(PluginList&)) {
  return {kPluginAbi, build_fingerprint(), name, version, list};
}

/// Where core finds plugins by kind and name; implemented by the plugin host.
class PluginCatalog {
 public:
  virtual ~PluginCatalog();
  /// The entry, or an Error (usage) at `where` that lists what exists, a suggestion and the folders searched.
  [[nodiscard]] virtual const PluginEntry& entry(std::string_view kind, std::string_view name,
                                                 const SourceLocation& where) const = 0;
  /// All entries, by kind, then name.
  [[nodiscard]] virtual std::vector<const PluginEntry*> entries() const = 0;
};

}  // namespace scree
