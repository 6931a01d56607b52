// What every BroadPhase owes: the conformance suite of the interface, which scree-conformance instantiates for the phases
// of a plugin. A test of variants instantiates it with ways to make them:
//
//     INSTANTIATE_TEST_SUITE_P(grid, BroadPhaseConformance, testing::Values(
//         BroadPhaseCase{"grid", [] { return std::make_unique<Grid>(); }}), broad_phase_case_name);
#pragma once

#include "conformance/broad_phase_case.hpp"

namespace scree::test {

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

// Law: a phase that lived through other steps reports what a new one does. Sizes change a hundredfold on the way, boxes
// pass through each other, keys vanish and others come, some in no order, some become movable.
TEST_P(BroadPhaseConformance, history_does_not_show) {
  RandomNumbers random{17};
  TestBoxes boxes;
  std::size_t found = 0;
  for (int frame = 0; frame < 30; ++frame) {
    const double size = frame < 15 ? 1e-3 : 1e-1;
    for (int k = 0; k < 60; ++k) boxes.add(random.in_cube(6 * size), size * Vec3{1, 0.5, 0.8}, k % 4 != 0);
    while (boxes.key.size() > 200) boxes.remove(random.below(boxes.key.size()));
    for (Aabb& box : boxes.box) {
      const Vec3 way = random.in_cube(size);
      box = {box.lower + way, box.upper + way};
    }
    const std::size_t i = random.below(boxes.key.size()), j = random.below(boxes.key.size());
    std::swap(boxes.key[i], boxes.key[j]);
    boxes.movable[i] = 1;
    const PairSet pairs = pairs_of(*phase_, boxes.view());
    EXPECT_EQ(pairs, pairs_of(*GetParam().make(), boxes.view())) << "frame " << frame;
    EXPECT_EQ(pairs, brute_force(boxes.view())) << "frame " << frame;
    found += pairs.size();
  }
  EXPECT_GT(found, 1000u);
}

TEST_P(BroadPhaseConformance, threads_change_nothing) {
  const TestBoxes boxes = polydisperse(1500, 31);
  const auto other = GetParam().make();
  EXPECT_EQ(pairs_of(*phase_, boxes.view(), 1), pairs_of(*other, boxes.view(), 2));
}

}  // namespace scree::test
