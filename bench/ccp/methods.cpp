#include "methods.hpp"

#include <cstdlib>
#include <stdexcept>

#include "scree/config/validate.hpp"

namespace scree::bench {

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> out{""};
  for (const char c : text) {
    if (c == at) {
      out.emplace_back();
    } else {
      out.back().push_back(c);
    }
  }
  return out;
}

const PluginHost& plugin_host() {
  static PluginHost plugins;
  if (plugins.entries().empty()) {
    const char* const folder = std::getenv("SCREE_PLUGIN_PATH");
    plugins.search(folder != nullptr ? folder : SCREE_BENCH_PLUGINS);
  }
  return plugins;
}

Method method_of(const std::string& text) {
  const std::size_t brace = text.find('{');
  if (brace == std::string::npos) return {text, text, ""};
  return {text, text.substr(0, brace), text.substr(brace + 1, text.size() - brace - 2)};
}

std::vector<Method> methods_of(const std::vector<std::string>& only) {
  std::vector<Method> out;
  for (const std::string& text : only) out.push_back(method_of(text));
  if (!out.empty()) return out;
  for (const PluginEntry* entry : plugin_host().entries()) {
    if (entry->kind == CcpSolver::kKind) out.push_back(method_of(entry->name));
  }
  out.push_back({"plain apgd", "apgd", "scaled = false"});
  return out;
}

std::unique_ptr<CcpSolver> make_solver(const std::string& plugin, const std::string& toml) {
  const PluginEntry& entry = plugin_host().entry(CcpSolver::kKind, plugin, {});
  std::unique_ptr<Plugin> made = entry.make(options_from_text(toml, entry.parameters));
  auto* const solver = dynamic_cast<CcpSolver*>(made.get());
  if (solver == nullptr) throw std::runtime_error{plugin + " is no solver"};
  static_cast<void>(made.release());
  return std::unique_ptr<CcpSolver>{solver};
}

}  // namespace scree::bench
