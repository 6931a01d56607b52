// What the conformance suite of broad phases works with: ways to make a phase, boxes, and all pairs by brute force.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scree/interfaces/broad_phase.hpp"
#include "scree/parallel/executor.hpp"
#include "support/random_numbers.hpp"

namespace scree::test {

/// One way to make a broad phase.
struct BroadPhaseCase {
  std::string name;
  std::function<std::unique_ptr<BroadPhase>()> make;
};

inline std::string broad_phase_case_name(const testing::TestParamInfo<BroadPhaseCase>& info) { return info.param.name; }

/// Owns the boxes of a step.
struct TestBoxes {
  std::vector<std::uint64_t> key;
  std::vector<Aabb> box;
  std::vector<char> movable;
  std::vector<std::uint32_t> owner;

  void add(const Vec3& centre, const Vec3& half, bool can_move = true) {
    key.push_back(next_key++);
    box.push_back({centre - half, centre + half});
    movable.push_back(can_move ? 1 : 0);
    owner.push_back(static_cast<std::uint32_t>(owner.size()));
  }
  void remove(std::size_t i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    key.erase(key.begin() + at);
    box.erase(box.begin() + at);
    movable.erase(movable.begin() + at);
    owner.erase(owner.begin() + at);
  }
  [[nodiscard]] BoxView view() const { return {key, box, movable, owner}; }
  std::uint64_t next_key = 7;
};

using PairSet = std::set<std::pair<ColliderIndex, ColliderIndex>>;

inline bool wanted(const BoxView& b, std::size_t i, std::size_t j) {
  return overlap(b.box[i], b.box[j]) && (b.movable[i] != 0 || b.movable[j] != 0) && b.owner[i] != b.owner[j];
}

/// All wanted pairs, by comparing everything with everything.
inline PairSet brute_force(const BoxView& b) {
  PairSet pairs;
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (std::size_t j = i + 1; j < b.size(); ++j) {
      if (wanted(b, i, j)) pairs.insert({static_cast<ColliderIndex>(i), static_cast<ColliderIndex>(j)});
    }
  }
  return pairs;
}

/// What a phase reports, after the host's filter; `reported` counts what there was before it.
inline PairSet pairs_of(BroadPhase& phase, const BoxView& b, int threads = 1, std::size_t* reported = nullptr) {
  const Executor executor{threads};
  std::vector<CandidatePair> out;
  phase.find_pairs(b, executor, out);
  PairSet pairs;
  for (const CandidatePair& p : out) {
    EXPECT_LT(std::max(p.a, p.b), b.size());
    if (wanted(b, p.a, p.b)) pairs.insert({std::min(p.a, p.b), std::max(p.a, p.b)});
  }
  if (reported != nullptr) *reported = out.size();
  return pairs;
}

class BroadPhaseConformance : public testing::TestWithParam<BroadPhaseCase> {
 protected:
  std::unique_ptr<BroadPhase> phase_ = GetParam().make();
};

/// Boxes of sizes over four decades, dense enough to meet, some of them immovable.
inline TestBoxes polydisperse(std::size_t count, std::uint64_t seed) {
  RandomNumbers random{seed};
  TestBoxes boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const double size = random.decades(1e-4, 1.0);
    const Vec3 half{size * random.uniform(0.2, 1.0), size * random.uniform(0.2, 1.0), size * random.uniform(0.2, 1.0)};
    // Small ones crowd together, so that they meet each other too.
    const Vec3 centre = random.uniform(0, 1) < 0.5 ? random.in_cube(1.5) : random.in_cube(4.0 * std::sqrt(size) * 0.1);
    boxes.add(centre, half, random.uniform(0, 1) < 0.8);
  }
  return boxes;
}

}  // namespace scree::test
