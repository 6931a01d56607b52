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

/// A pose in which the chain once gave a wrong contact.
struct OncePose {
  ShapeKind a, b;
  int trial;
};

constexpr auto kBox = ShapeKind::box, kHull = ShapeKind::convex_hull, kCapsule = ShapeKind::capsule,
               kMesh = ShapeKind::triangle_mesh, kCone = ShapeKind::cone;
constexpr OncePose kOnce[] = {
    // The walk to the nearest points ended with another simplex than the distance it reported.
    {kBox, kBox, 234},
    {kBox, kBox, 971},
    {kBox, kBox, 1994},
    {kBox, kHull, 1810},
    {kBox, kHull, 2419},
    {kBox, kMesh, 120},
    {kBox, kMesh, 2083},
    {kBox, kMesh, 3547},
    // Four corners of one parallelogram were taken for a tetrahedron with the origin inside.
    {kBox, kHull, 499},
    // The deepest corner lay far beside the face that was the reference.
    {kBox, kBox, 6341},
    {kBox, kBox, 8859},
    {kBox, kCapsule, 3389},
    {kBox, kHull, 4116},
    {kBox, kHull, 6026},
    // Parallel edges that do not lie over each other.
    {kCapsule, kMesh, 2157},
    // A triangle that is cut beside its face; a corner so sharp that the way out looks against a triangle's normal.
    {kBox, kMesh, 566},
    {kHull, kMesh, 5224},
    // Bullet's points lay outside of the solids.
    {kCone, kCone, 997},
    // A corner or tip through a facet was led out beside it, as if the solid ended there.
    {kCone, kMesh, 807},
    {kCone, kMesh, 966},
    {kCone, kMesh, 2335},
    {kCone, kMesh, 2926},
    {kMesh, kMesh, 1384},
    {kMesh, kMesh, 7664},
    {kMesh, kMesh, 8553},
    {kMesh, kMesh, 9989},
};

// Law: a fault that has been mended stays mended.
TEST(DefaultChain, holds_where_it_once_failed) {
  for (const OncePose& once : kOnce) {
    const bool swapped = once.trial % 3 == 1;  // as the suite does
    const NarrowPhasePose pose = narrow_phase_pose(swapped ? once.b : once.a, swapped ? once.a : once.b, once.trial);
    EXPECT_EQ(fault_of(*make_phase(*entry_for(once.a, once.b)), pose), "")
        << to_string(once.a) << " and " << to_string(once.b) << ", " << pose.description;
  }
}

}  // namespace
}  // namespace scree::test
