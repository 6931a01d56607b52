#include "grid.hpp"

#include "conformance/broad_phase_case.hpp"

namespace scree {
namespace {

using namespace test;

// Law: a box that covers everything costs one candidate a box, not one a cell; a candidate is reported once.
TEST(Grid, a_drum_costs_one_candidate_a_grain) {
  TestBoxes boxes;
  boxes.add({0, 0, 0}, {1, 1, 1}, false);
  for (int i = 0; i < 4096; ++i) {
    boxes.add({-0.8 + 0.1 * (i % 16), -0.8 + 0.1 * (i / 16 % 16), -0.8 + 0.1 * (i / 256)}, {2.5e-4, 2.5e-4, 2.5e-4});
  }
  Grid grid;
  std::size_t reported = 0;
  EXPECT_EQ(pairs_of(grid, boxes.view(), 2, &reported).size(), 4096u);
  EXPECT_EQ(reported, 4096u);
}

// Law: candidates grow with the number of boxes, even when two piles lie metres apart and between them is nothing.
TEST(Grid, reports_each_pair_once_in_distant_piles) {
  RandomNumbers random{5};
  TestBoxes boxes;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 pile = i % 2 == 0 ? Vec3{} : Vec3{40, -30, 5};
    boxes.add(pile + random.in_cube(0.02), {5e-4, 5e-4, 5e-4});
  }
  Grid grid;
  std::size_t reported = 0;
  const PairSet pairs = pairs_of(grid, boxes.view(), 1, &reported);
  EXPECT_EQ(pairs, brute_force(boxes.view()));
  // Rounding of boxes to single precision, tens of metres away, lets a few near misses through (edge 1 mm, error 2e-6 m).
  EXPECT_LE(reported, pairs.size() + pairs.size() / 10 + 10);
}

}  // namespace
}  // namespace scree
