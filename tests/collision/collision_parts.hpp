// What the tests of whole collision chains share: phases as a scene loads them, and contacts compared bit by bit.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "scree/collision/contact.hpp"
#include "scree/config/options.hpp"
#include "scree/host/plugin_host.hpp"

namespace scree::test {

/// All plugins in the folder that the build put them in.
inline PluginHost& plugin_host() {
  static PluginHost* const host = [] {
    auto* made = new PluginHost;  // plugins are never unloaded
    made->search(SCREE_PLUGINS);
    return made;
  }();
  return *host;
}

/// The plugin of that name, with all its defaults.
template <class Interface>
std::unique_ptr<Interface> make_plugin(const std::string& name) {
  auto plugin = plugin_host().entry(Interface::kKind, name, {}).make(Options{});
  return std::unique_ptr<Interface>{dynamic_cast<Interface*>(plugin.release())};
}

/// Whether two lists hold the same contacts, in the same order, with the same bits.
inline bool same_bits(std::span<const Contact> l, std::span<const Contact> r) {
  const auto same = [](const Contact& x, const Contact& y) {
    const auto bits = [](const Contact& c) {
      const std::array<double, 7> values{c.point.x, c.point.y, c.point.z, c.normal.x, c.normal.y, c.normal.z, c.gap};
      return std::bit_cast<std::array<std::uint64_t, 7>>(values);
    };
    return x.a == y.a && x.b == y.b && x.primitive_a == y.primitive_a && x.primitive_b == y.primitive_b &&
           x.feature == y.feature && bits(x) == bits(y);
  };
  return l.size() == r.size() && std::equal(l.begin(), l.end(), r.begin(), same);
}

}  // namespace scree::test
