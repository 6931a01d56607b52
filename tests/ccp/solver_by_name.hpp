// CCP solvers as a scene loads them.
#pragma once

#include <memory>
#include <string>

#include "scree/config/validate.hpp"
#include "scree/host/plugin_host.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree::test {

/// A solver with its default options. Needs SCREE_PLUGINS, the folder of the plugins.
inline std::unique_ptr<CcpSolver> solver_named(const std::string& name) {
  static PluginHost* const host = [] {
    auto* made = new PluginHost;  // plugins are never unloaded
    made->search(SCREE_PLUGINS);
    return made;
  }();
  const PluginEntry& entry = host->entry(CcpSolver::kKind, name, {});
  return std::unique_ptr<CcpSolver>{dynamic_cast<CcpSolver*>(entry.make(default_options(entry.parameters)).release())};
}

}  // namespace scree::test
