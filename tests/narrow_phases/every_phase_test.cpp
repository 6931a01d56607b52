// All narrow phases over the same poses of every pair of kinds; and the chain of those that a scene gets which names none:
// it covers every pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "conformance/hollow_drum_case.hpp"
#include "conformance/narrow_phase_case.hpp"
#include "scree/host/plugin_host.hpp"
#include "support/trials.hpp"

namespace scree::test {
namespace {

/// All narrow phases, from the folder that the build put them in.
std::vector<const PluginEntry*> entries() {
  static PluginHost* const host = [] {
    auto* made = new PluginHost;  // plugins are never unloaded
    made->search(SCREE_PLUGINS);
    return made;
  }();
  std::vector<const PluginEntry*> entries;
  for (const PluginEntry* entry : host->entries()) {
    if (entry->kind == NarrowPhase::kKind) entries.push_back(entry);
  }
  return entries;
}

/// The entries of the chain, in order.
std::vector<const PluginEntry*> chain_entries() {
  std::vector<const PluginEntry*> chain;
  std::ranges::copy_if(entries(), std::back_inserter(chain),
                       [](const auto* entry) { return entry->default_place > 0; });
  std::ranges::sort(chain, {}, &PluginEntry::default_place);
  return chain;
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

/// Two kinds, and all phases that support them: the chain's is one of them.
struct KindPair {
  ShapeKind a = ShapeKind::sphere, b = ShapeKind::sphere;
  std::vector<NarrowPhaseCase> phases;
};

std::ostream& operator<<(std::ostream& out, const KindPair& pair) {
  return out << to_string(pair.a) << " and " << to_string(pair.b);
}

std::vector<KindPair> kind_pairs() {
  std::vector<KindPair> list;
  for (std::size_t a = 0; a < kShapeKindCount; ++a) {
    for (std::size_t b = a; b < kShapeKindCount; ++b) {
      KindPair pair{static_cast<ShapeKind>(a), static_cast<ShapeKind>(b), {}};
      for (const PluginEntry* entry : entries()) {
        if (!make_phase(*entry)->supports(pair.a, pair.b)) continue;
        pair.phases.push_back({entry->name, [entry] { return make_phase(*entry); }, pair.a, pair.b});
      }
      if (!pair.phases.empty()) list.push_back(std::move(pair));
    }
  }
  return list;
}

class EveryNarrowPhase : public testing::TestWithParam<KindPair> {};

// Law: as the suite of the interface has it. What is true of a pose is found once, and every phase is judged by it.
TEST_P(EveryNarrowPhase, contacts_are_true_and_none_is_missing) {
  const KindPair& pair = GetParam();
  const int count = trials(300);
  std::vector<int> faults(pair.phases.size());
  for (int trial = 0; trial < count; ++trial) {
    const bool swapped = trial % 3 == 1;  // as the suite does
    const NarrowPhasePose pose = narrow_phase_pose(swapped ? pair.b : pair.a, swapped ? pair.a : pair.b, trial);
    for (std::size_t k = 0; k < pair.phases.size(); ++k) {
      const NarrowPhaseCase& phase = pair.phases[k];
      const std::string fault = fault_of(*phase.make(), pose);
      if (fault.empty() || is_declared_exception(phase, trial)) continue;
      if (++faults[k] <= 5) ADD_FAILURE() << phase.name << ", " << pose.description << ": " << fault;
    }
  }
  for (std::size_t k = 0; k < pair.phases.size(); ++k) {
    EXPECT_EQ(faults[k], 0) << pair.phases[k].name << ", of " << count << " poses";
  }
}

INSTANTIATE_TEST_SUITE_P(kinds, EveryNarrowPhase, testing::ValuesIn(kind_pairs()), [](const auto& each) {
  return std::string{to_string(each.param.a)} + "_and_" + to_string(each.param.b);
});

/// The phases that support a kind inside of a hollow cylinder.
std::vector<const PluginEntry*> entries_for_drum(ShapeKind inside) {
  std::vector<const PluginEntry*> list;
  std::ranges::copy_if(entries(), std::back_inserter(list),
                       [&](const auto* entry) { return make_phase(*entry)->supports_hollow(inside); });
  return list;
}

class InHollowDrum : public testing::TestWithParam<ShapeKind> {};

TEST_P(InHollowDrum, contacts_are_true_and_none_is_missing) {
  int faults = 0;
  for (int trial = 0; trial < trials(300); ++trial) {
    const DrumPose pose = drum_pose(GetParam(), trial);
    for (const PluginEntry* entry : entries_for_drum(GetParam())) {
      const std::string fault = fault_of(*make_phase(*entry), pose);
      if (!fault.empty() && ++faults <= 5) ADD_FAILURE() << entry->name << ", " << pose.description << ": " << fault;
    }
  }
  EXPECT_EQ(faults, 0);
}

INSTANTIATE_TEST_SUITE_P(kinds, InHollowDrum,
                         testing::Values(ShapeKind::sphere, ShapeKind::sphere_cluster, ShapeKind::box,
                                         ShapeKind::cylinder, ShapeKind::capsule, ShapeKind::cone,
                                         ShapeKind::convex_hull, ShapeKind::triangle_mesh, ShapeKind::ellipsoid),
                         [](const auto& each) { return std::string{to_string(each.param)} + "_and_drum"; });

// Law: whatever lies in a hollow drum, some phase of the chain takes it.
TEST(DefaultChain, covers_every_kind_in_a_hollow_drum) {
  for (std::size_t k = 0; k < kShapeKindCount; ++k) {
    const auto kind = static_cast<ShapeKind>(k);
    EXPECT_TRUE(std::ranges::any_of(chain_entries(), [&](const auto* entry) {
      return make_phase(*entry)->supports_hollow(kind);
    })) << to_string(kind);
  }
}

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

// Law: the middle of a cluster may lie inside of a mesh that none of its spheres touches.
TEST(EveryNarrowPhaseOnce, a_cluster_about_a_mesh_is_not_inside) {
  for (const int trial : {913, 1149}) {
    const bool swapped = trial % 3 == 1;
    const ShapeKind cluster = ShapeKind::sphere_cluster;
    const NarrowPhasePose pose = narrow_phase_pose(swapped ? kMesh : cluster, swapped ? cluster : kMesh, trial);
    for (const PluginEntry* entry : entries()) {
      const auto phase = make_phase(*entry);
      if (phase->supports(cluster, kMesh)) {
        EXPECT_EQ(fault_of(*phase, pose), "") << entry->name;
      }
    }
  }
}

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
