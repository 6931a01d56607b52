// The chain of narrow phases that a scene gets which names none: it covers every pair of kinds, and its contacts are true.
#include <algorithm>

#include "conformance/narrow_phase_conformance.hpp"
#include "scree/host/plugin_host.hpp"

namespace scree::test {
namespace {

/// The entries of the chain, in order, from the folder that the build put them in.
std::vector<const PluginEntry*> chain_entries() {
  static PluginHost* const host = [] {
    auto* made = new PluginHost;  // plugins are never unloaded
    made->search(SCREE_PLUGINS);
    return made;
  }();
  std::vector<const PluginEntry*> entries;
  for (const PluginEntry* entry : host->entries()) {
    if (entry->kind == NarrowPhase::kKind && entry->default_place > 0) entries.push_back(entry);
  }
  std::ranges::sort(entries, {}, &PluginEntry::default_place);
  return entries;
}

std::unique_ptr<NarrowPhase> make_phase(const PluginEntry& entry) {
  return std::unique_ptr<NarrowPhase>{dynamic_cast<NarrowPhase*>(entry.make(Options{}).release())};
}

/// The first phase of the chain that supports a pair; nothing when none does.
const PluginEntry* entry_for(ShapeKind a, ShapeKind b) {
  for (const PluginEntry* entry : chain_entries()) {
    if (make_phase(*entry)->supports(a, b)) return entry;
  }
  return nullptr;
}

std::vector<NarrowPhaseCase> cases() {
  constexpr int kPoses = 300;
  std::vector<NarrowPhaseCase> list;
  for (std::size_t a = 0; a < kShapeKindCount; ++a) {
    for (std::size_t b = a; b < kShapeKindCount; ++b) {
      const auto kind_a = static_cast<ShapeKind>(a), kind_b = static_cast<ShapeKind>(b);
      const PluginEntry* entry = entry_for(kind_a, kind_b);
      if (entry == nullptr) continue;
      list.push_back({entry->name, [entry] { return make_phase(*entry); }, kind_a, kind_b, kPoses});
    }
  }
  return list;
}

INSTANTIATE_TEST_SUITE_P(chain, NarrowPhaseConformance, testing::ValuesIn(cases()), narrow_phase_case_name);

// Law: whatever two kinds a scene brings together, but two half spaces, some phase of the chain takes them.
TEST(DefaultChain, covers_every_pair_of_kinds) {
  for (std::size_t a = 0; a < kShapeKindCount; ++a) {
    for (std::size_t b = 0; b < kShapeKindCount; ++b) {
      const auto kind_a = static_cast<ShapeKind>(a), kind_b = static_cast<ShapeKind>(b);
      if (kind_a == ShapeKind::plane && kind_b == ShapeKind::plane) continue;
      EXPECT_NE(entry_for(kind_a, kind_b), nullptr) << to_string(kind_a) << " and " << to_string(kind_b);
    }
  }
}

}  // namespace
}  // namespace scree::test
