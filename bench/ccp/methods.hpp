// The solvers that a benchmark tries: plugins as built, by name and settings.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scree/host/plugin_host.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree::bench {

/// A solver with its settings.
struct Method {
  std::string name;    ///< in tables
  std::string plugin;  ///< its plugin's name
  std::string toml;    ///< settings, empty for the defaults
};

/// The parts of `text` between the characters `at`; one at least.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char at);

/// All plugins of the folder SCREE_PLUGIN_PATH, or of this build.
[[nodiscard]] const PluginHost& plugin_host();

/// "NAME" or "NAME{KEY = VALUE}".
[[nodiscard]] Method method_of(const std::string& text);

/// Those named in `only`; none named: every solver with its defaults, and apgd as in the paper, "plain apgd".
[[nodiscard]] std::vector<Method> methods_of(const std::vector<std::string>& only);

/// @throws Error (config) for names and settings that do not exist.
[[nodiscard]] std::unique_ptr<CcpSolver> make_solver(const std::string& plugin, const std::string& toml = "");

}  // namespace scree::bench
