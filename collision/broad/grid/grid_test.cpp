#include "grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "conformance/broad_phase_case.hpp"

namespace scree {
namespace {

using namespace test;

// Law: a box that covers everything costs one candidate a box, not one a cell; a candidate is reported once.
TEST(Grid, a_drum_costs_one_candidate_a_grain) {
  TestBoxes boxes;
  boxes.add({0, 0, 0}, {1, 1, 1}, false);
  for (int i = 0; i < 4096; ++i) {
    const int row = i / 16, layer = row / 16;
    boxes.add({-0.8 + 0.1 * (i % 16), -0.8 + 0.1 * (row % 16), -0.8 + 0.1 * layer}, {2.5e-4, 2.5e-4, 2.5e-4});
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

/// Balls and margins, some without bounds, some not even numbers; pairs whose grown balls meet, by comparing all.
struct TestBalls {
  std::vector<BoundingBall> ball;
  std::vector<double> margin;
  std::vector<std::uint64_t> key;
  std::vector<char> movable;
  std::vector<std::uint32_t> owner;

  void add(const Vec3& centre, double radius, double grown_by) {
    ball.push_back({centre, radius});
    margin.push_back(grown_by);
    key.push_back(key.size());
    movable.push_back(1);
    owner.push_back(static_cast<std::uint32_t>(owner.size()));
  }
  [[nodiscard]] BoxView view() const { return {key, {}, movable, owner, ball, margin}; }
  /// Meeting within `radii` times the sum of the grown radii.
  [[nodiscard]] PairSet pairs(double radii) const {
    PairSet found;
    for (ColliderIndex b = 0; b < ball.size(); ++b) {
      for (ColliderIndex a = 0; a < b; ++a) {
        const double reach = ball[a].radius + margin[a] + ball[b].radius + margin[b];
        if (std::isfinite(reach) && norm(ball[a].centre - ball[b].centre) <= radii * reach) found.insert({a, b});
      }
    }
    return found;
  }
};

PairSet reported_by(Grid& grid, const TestBalls& balls, int threads) {
  const Executor executor{threads};
  std::vector<CandidatePair> out;
  grid.find_pairs(balls.view(), executor, out);
  PairSet pairs;
  for (const CandidatePair& p : out) pairs.insert({std::min(p.a, p.b), std::max(p.a, p.b)});
  EXPECT_EQ(pairs.size(), out.size()) << "each pair once";
  return pairs;
}

// Law: of balls alone, each pair whose grown balls meet is reported once, for any number of threads, and nothing that is further
// apart than single precision can tell (rounding below 1e-6 of coordinates of a metre, on radii of half a millimetre: 1 %);
// what has no bounds meets nothing.
TEST(Grid, balls_alone_are_found) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  for (const double spread : {1.0, 40.0}) {
    RandomNumbers random{41};
    TestBalls balls;
    for (int i = 0; i < 3000; ++i) {
      const double radius = random.uniform(0.5e-3, 0.5e-3 * spread);
      balls.add(random.in_cube(0.007 * spread), radius, random.uniform(0.0, 0.2 * radius));
      if (i % 1000 == 0) balls.add({0, 0, 0}, kInf, 0.0);
      if (i % 1000 == 1) balls.add({kNan, 0, 0}, 1e-3, 0.0);
      if (i % 1000 == 2) balls.add({0, 0, 0}, 1e-3, kNan);
    }
    Grid grid;
    const PairSet pairs = reported_by(grid, balls, 1);
    EXPECT_EQ(pairs, reported_by(grid, balls, 2));
    EXPECT_GT(pairs.size(), 1000u);
    const PairSet least = balls.pairs(1.0), most = balls.pairs(1.01);
    EXPECT_TRUE(std::ranges::includes(pairs, least));
    EXPECT_TRUE(std::ranges::includes(most, pairs));
  }
}

// Law: balls that got lost, a light year away or swollen to one, hide no pair of the others, nor do they pair with all.
TEST(Grid, a_far_ball_hides_nothing) {
  TestBalls balls;
  for (int i = 0; i < 50; ++i) balls.add({1e-3 * i, 0, 0}, 0.6e-3, 0.0);
  const PairSet expected = balls.pairs(1.0);
  balls.add({1e300, -1e300, 1e20}, 1e-3, 0.0);
  balls.add({0, 0, 0}, 1e-3, 1e16);
  Grid grid;
  EXPECT_EQ(reported_by(grid, balls, 1), expected);
}

}  // namespace
}  // namespace scree
