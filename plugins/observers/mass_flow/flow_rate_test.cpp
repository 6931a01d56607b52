#include "flow_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace scree {
namespace {

/// Intervals side by side from 0 on, of the lengths given [s].
struct Rows {
  explicit Rows(const std::vector<double>& lengths) {
    for (const double length : lengths) {
      begin.push_back(end.empty() ? 0.0 : end.back());
      end.push_back(begin.back() + length);
    }
    amount.assign(lengths.size(), 0.0);
  }
  [[nodiscard]] FlowRate rate(double from, double to, std::size_t blocks) const {
    return constant_rate(begin, end, amount, from, to, blocks, 0.95);
  }
  std::vector<double> begin, end, amount;
};

// Whatever the number of intervals, all that passed in the window counts, over all of its time.
TEST(flow_rate, is_what_passed_in_the_window_over_its_length) {
  for (const std::size_t count : {1U, 7U, 10U, 11U, 19U, 20U, 37U}) {
    std::vector<double> lengths(count, 0.1);
    if (count > 1) lengths.back() = 0.013;
    Rows rows{lengths};
    for (std::size_t k = 0; k < count; ++k) rows.amount[k] = 1.0 + static_cast<double>(k * k % 5);
    const FlowRate flow = rows.rate(0.0, 1e9, 10);
    const double all = std::accumulate(rows.amount.begin(), rows.amount.end(), 0.0);
    EXPECT_EQ(flow.from, 0.0);
    EXPECT_EQ(flow.to, rows.end.back());
    EXPECT_EQ(flow.blocks, std::min<std::size_t>(10, count));
    EXPECT_NEAR(flow.rate.value, all / rows.end.back(), 1e-13 * all / rows.end.back()) << count;
  }
}

TEST(flow_rate, uses_the_intervals_that_lie_within_the_window) {
  Rows rows{std::vector<double>(10, 0.1)};
  for (std::size_t k = 0; k < 10; ++k) rows.amount[k] = k < 2 || k > 6 ? 100.0 : 0.5;
  const FlowRate flow = rows.rate(0.15, 0.7, 3);
  EXPECT_NEAR(flow.from, 0.2, 1e-15);
  EXPECT_NEAR(flow.to, 0.7, 1e-15);
  EXPECT_NEAR(flow.rate.value, 5.0, 1e-13);
  EXPECT_TRUE(std::isnan(rows.rate(2.0, 3.0, 3).rate.value));
}

// Blocks of 1, 1 and 2 s with the rates 3, 1 and 2: mean 2, squares by length 1 + 1 + 0, so sqrt(2 / 2 / 4) is the standard
// error; t of two degrees of freedom is 4.303. The drift by hand: middles 0.5, 1.5, 3.
TEST(flow_rate, weighs_blocks_by_their_length) {
  Rows rows{{1.0, 1.0, 2.0}};
  rows.amount = {3.0, 1.0, 4.0};
  const FlowRate flow = rows.rate(0.0, 4.0, 3);
  EXPECT_EQ(flow.blocks, 3u);
  EXPECT_DOUBLE_EQ(flow.rate.value, 2.0);
  EXPECT_NEAR(flow.rate.error, 4.303 * 0.5, 3e-4);
  // Middle of the middles 2; sum w x^2 = 2.25 + 0.25 + 2, sum w x y = -1.5 + 0.5 + 0.
  EXPECT_NEAR(flow.drift.value, -1.0 / 4.5, 1e-15);
}

// Law: the interval of 95 % holds the true rate in 95 % of the trials, also where blocks cannot be equal: 19 intervals for
// 10 of them. Poisson arrivals; 2000 trials know the share to 0.5 %, four of which are 2 %.
TEST(flow_rate, holds_the_true_rate_as_often_as_it_says_with_unequal_blocks) {
  std::mt19937_64 random{7};
  std::poisson_distribution<int> arrivals{20.0};
  int held = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Rows rows{std::vector<double>(19, 0.1)};
    for (double& amount : rows.amount) amount = arrivals(random);
    const FlowRate flow = rows.rate(0.0, 10.0, 10);
    held += std::abs(flow.rate.value - 200.0) <= flow.rate.error ? 1 : 0;
  }
  EXPECT_NEAR(held / 2000.0, 0.95, 0.02);
}

}  // namespace
}  // namespace scree
