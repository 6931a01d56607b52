// Phases by name, from the plugins of the build.
#pragma once

#include <memory>
#include <string>

#include "scree/config/validate.hpp"
#include "scree/host/plugin_host.hpp"

namespace scree::bench {

inline PluginHost& plugin_host() {
  static PluginHost* const host = [] {
    auto* made = new PluginHost;  // plugins are never unloaded
    made->search(SCREE_PLUGINS);
    return made;
  }();
  return *host;
}

/// True when the build has this plugin.
inline bool is_built(const std::string& kind, const std::string& name) {
  for (const PluginEntry* entry : plugin_host().entries()) {
    if (entry->kind == kind && entry->name == name) return true;
  }
  return false;
}

/// A plugin with its defaults. @throws Error for a name that does not exist, with those that do.
template <class Interface>
std::unique_ptr<Interface> make_plugin(const std::string& name) {
  const PluginEntry& entry = plugin_host().entry(Interface::kKind, name, {});
  auto plugin = entry.make(default_options(entry.parameters));
  return std::unique_ptr<Interface>{dynamic_cast<Interface*>(plugin.release())};
}

}  // namespace scree::bench
