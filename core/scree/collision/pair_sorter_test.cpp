#include "scree/collision/pair_sorter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/random_numbers.hpp"

namespace scree {
namespace {

using Pair = std::pair<ColliderIndex, ColliderIndex>;

std::vector<Pair> in_order(PairSorter& sorter, std::size_t first, std::size_t last) {
  std::vector<Pair> out;
  sorter.in_order(first, last, [&](std::span<const CandidatePair> pairs) {
    for (const CandidatePair& p : pairs) out.emplace_back(p.a, p.b);
  });
  return out;
}

// Law: what comes out is what went in, the smaller index first, sorted; doubles stay. Colliders have none to many partners: what is
// sorted by a network, by insertion, and a collider that meets all.
TEST(PairSorter, sorts_all_pairs) {
  test::RandomNumbers random{3};
  constexpr std::size_t kColliders = 3000;
  PairSorter sorter;
  for (const std::size_t count : {0u, 1u, 4000u, 30000u}) {
    std::vector<CandidatePair> candidates;
    std::multiset<Pair> expected;
    const auto add = [&](std::size_t i, std::size_t j) {
      candidates.push_back({static_cast<ColliderIndex>(i), static_cast<ColliderIndex>(j)});
      expected.insert(std::minmax(candidates.back().a, candidates.back().b));
    };
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = random.below(kColliders);
      add(i, (i + 1 + random.below(kColliders - 1)) % kColliders);
    }
    for (std::size_t j = 0; count > 1 && j < kColliders; ++j) {
      if (j != 17) add(j, 17);
    }
    sorter.sort(candidates, kColliders);
    EXPECT_EQ(sorter.size(), candidates.size());
    EXPECT_EQ(in_order(sorter, 0, kColliders), std::vector<Pair>(expected.begin(), expected.end()));
    // In parts, as threads ask for them; and again, which changes nothing.
    std::vector<Pair> parts = in_order(sorter, 0, 16);
    for (const Pair& pair : in_order(sorter, 16, 18)) parts.push_back(pair);
    for (const Pair& pair : in_order(sorter, 18, kColliders)) parts.push_back(pair);
    EXPECT_EQ(parts, std::vector<Pair>(expected.begin(), expected.end()));
    EXPECT_EQ(sorter.begin(kColliders), candidates.size());
  }
}

}  // namespace
}  // namespace scree
