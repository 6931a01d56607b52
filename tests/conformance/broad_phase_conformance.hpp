// What every BroadPhase owes: the conformance suite of the interface.
//
// A phase's test instantiates it with ways to make the phase:
//
//     INSTANTIATE_TEST_SUITE_P(grid, BroadPhaseConformance, testing::Values(
//         BroadPhaseCase{"grid", [] { return std::make_unique<Grid>(); }}), broad_phase_case_name);
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

// Law: every pair of boxes that overlap is reported, for sizes of 1 to 10^4, and nothing is lost while boxes move, come
// and go.
TEST_P(BroadPhaseConformance, finds_what_brute_force_finds) {
  RandomNumbers random{11};
  TestBoxes boxes = polydisperse(600, 12);
  std::size_t found = 0;
  for (int frame = 0; frame < 25; ++frame) {
    const PairSet expected = brute_force(boxes.view());
    EXPECT_EQ(pairs_of(*phase_, boxes.view()), expected) << "frame " << frame;
    found += expected.size();
    for (Aabb& box : boxes.box) {
      const Vec3 way = random.in_cube(random.decades(1e-5, 0.3));
      box = {box.lower + way, box.upper + way};
    }
    for (int k = 0; k < 20; ++k) boxes.remove(random.below(boxes.key.size()));
    const double size = random.decades(1e-4, 1.0);
    for (int k = 0; k < 20; ++k) boxes.add(random.in_cube(1.0), {size, size, size}, k % 3 != 0);
  }
  EXPECT_GT(found, 1000u) << "a test without pairs shows nothing";
}

// Law: the place of the scene does not matter, nor do outliers many kilometres away.
TEST_P(BroadPhaseConformance, finds_pairs_beside_far_outliers) {
  TestBoxes boxes = polydisperse(300, 21);
  for (Aabb& box : boxes.box) box = {box.lower + Vec3{100, -50, 7}, box.upper + Vec3{100, -50, 7}};
  boxes.add({-2e5, 3e4, 1e5}, {1e-3, 1e-3, 1e-3});
  boxes.add({-2e5, 3e4, 1e5}, {1e-3, 2e-3, 1e-3});
  boxes.add({0, 0, 0}, {300, 300, 300}, false);
  EXPECT_EQ(pairs_of(*phase_, boxes.view()), brute_force(boxes.view()));
}

TEST_P(BroadPhaseConformance, touching_boxes_overlap) {
  TestBoxes boxes;
  boxes.add({0, 0, 0}, {0.5, 0.5, 0.5});
  boxes.add({1, 1, 1}, {0.5, 0.5, 0.5});
  EXPECT_EQ(pairs_of(*phase_, boxes.view()), (PairSet{{0, 1}}));
}

TEST_P(BroadPhaseConformance, handles_none_one_and_points) {
  TestBoxes boxes;
  EXPECT_TRUE(pairs_of(*phase_, boxes.view()).empty());
  boxes.add({1, 2, 3}, {});
  EXPECT_TRUE(pairs_of(*phase_, boxes.view()).empty());
  boxes.add({1, 2, 3}, {});
  boxes.add({1, 2, 3.5}, {});
  EXPECT_EQ(pairs_of(*phase_, boxes.view()), (PairSet{{0, 1}}));
}

// Law: pairs of two immovable boxes and pairs of one owner are not even reported.
TEST_P(BroadPhaseConformance, keeps_unwanted_pairs_to_itself) {
  TestBoxes boxes;
  for (int i = 0; i < 40; ++i) boxes.add({0.01 * i, 0, 0}, {1, 1, 1}, i == 0);
  std::size_t reported = 0;
  EXPECT_EQ(pairs_of(*phase_, boxes.view(), 1, &reported).size(), 39u);
  EXPECT_LE(reported, 39u);
  std::fill(boxes.owner.begin(), boxes.owner.end(), 5u);
  EXPECT_TRUE(pairs_of(*phase_, boxes.view(), 1, &reported).empty());
  EXPECT_EQ(reported, 0u);
}

TEST_P(BroadPhaseConformance, threads_change_nothing) {
  const TestBoxes boxes = polydisperse(1500, 31);
  const auto other = GetParam().make();
  EXPECT_EQ(pairs_of(*phase_, boxes.view(), 1), pairs_of(*other, boxes.view(), 2));
}

}  // namespace scree::test
