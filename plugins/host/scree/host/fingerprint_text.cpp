#include "scree/host/fingerprint_text.hpp"

#include <fmt/format.h>

#include <string_view>

namespace scree {
namespace {

/// Appends one difference, when there is one.
template <class Value>
void compare(std::string& text, std::string_view what, const Value& plugin, const Value& here) {
  if (plugin == here) return;
  if (!text.empty()) text += "; ";
  text += fmt::format("{} {} in the plugin, {} here", what, plugin, here);
}

std::string layout_text(std::uint64_t layout) { return fmt::format("{:016x}", layout); }

}  // namespace

std::string fingerprint_differences(const BuildFingerprint& plugin, const BuildFingerprint& here) {
  std::string text;
  compare(text, "compiler", std::string_view{plugin.compiler}, std::string_view{here.compiler});
  compare(text, "C++ ABI", plugin.cxx_abi, here.cxx_abi);
  compare(text, "standard library release", plugin.library, here.library);
  compare(text, "_GLIBCXX_USE_CXX11_ABI", plugin.new_string_abi, here.new_string_abi);
  compare(text, "_GLIBCXX_DEBUG", plugin.debug_library, here.debug_library);
  compare(text, "bytes of a pointer", plugin.pointer_size, here.pointer_size);
  compare(text, "bytes of std::string", plugin.string_size, here.string_size);
  compare(text, "bytes of std::vector", plugin.vector_size, here.vector_size);
  compare(text, "layout of the interface structs", layout_text(plugin.layout), layout_text(here.layout));
  return text;
}

}  // namespace scree
