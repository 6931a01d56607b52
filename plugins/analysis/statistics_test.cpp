#include "analysis/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace scree {
namespace {

// Tables of Student's t (two-sided), to the digits printed there.
TEST(statistics, student_t_is_that_of_the_tables) {
  EXPECT_NEAR(student_t(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_t(0.95, 2), 4.303, 5e-4);
  EXPECT_NEAR(student_t(0.95, 3), 3.182, 5e-4);
  EXPECT_NEAR(student_t(0.95, 4), 2.776, 5e-4);
  EXPECT_NEAR(student_t(0.95, 9), 2.262, 5e-4);
  EXPECT_NEAR(student_t(0.99, 10), 3.169, 5e-4);
  EXPECT_NEAR(student_t(0.95, 120), 1.980, 5e-4);
}

// Law: an interval of 90 % holds the true mean in 90 % of the trials. 2000 trials: a standard deviation of 0.7 %, so 4 of
// them are 2.7 %.
TEST(statistics, confidence_intervals_hold_the_mean_as_often_as_they_say) {
  std::mt19937_64 random{1};
  std::normal_distribution<double> normal{3.0, 2.0};
  int held = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> values(6);
    for (double& value : values) value = normal(random);
    const Estimate mean = mean_with_interval(values, 0.9);
    held += std::abs(mean.value - 3.0) <= mean.error ? 1 : 0;
  }
  EXPECT_NEAR(held / 2000.0, 0.9, 0.027);
}

TEST(statistics, slope_is_that_of_a_line_and_its_error_that_of_the_textbook) {
  const std::vector<double> x{0, 1, 2, 3}, line{1, 3, 5, 7}, bent{0, 0, 1, 1};
  EXPECT_DOUBLE_EQ(slope(x, line).value, 2.0);
  EXPECT_NEAR(slope(x, line).error, 0.0, 1e-15);
  // By hand: slope 0.4, residuals 0.1, -0.3, 0.3, -0.1, squares 0.2; sqrt(0.2 / 2 / 5).
  EXPECT_NEAR(slope(x, bent).value, 0.4, 1e-15);
  EXPECT_NEAR(slope(x, bent).error, std::sqrt(0.02), 1e-15);
}

// By hand: mean 0.5 and 1 in x; squares 0.25 + 2 x 0.25 + 0.25 = 1; two degrees of freedom for the mean, one for the line.
TEST(statistics, weights_are_inverse_variances_and_only_their_ratios_count) {
  const std::vector<double> x{0, 1, 2}, y{0, 1, 0}, w{1, 2, 1}, tenfold{10, 20, 10}, equal{3, 3, 3};
  for (const std::vector<double>& weights : {w, tenfold}) {
    EXPECT_DOUBLE_EQ(mean_with_interval(y, weights, 0.95).value, 0.5);
    EXPECT_NEAR(mean_with_interval(y, weights, 0.95).error, 4.303 * std::sqrt(1.0 / 2.0 / 4.0), 2e-4);
    EXPECT_NEAR(slope(x, y, weights).value, 0.0, 1e-15);
    EXPECT_DOUBLE_EQ(slope(x, y, weights).error, std::sqrt(1.0 / 1.0 / 2.0));
  }
  EXPECT_DOUBLE_EQ(mean_with_interval(y, equal, 0.9).error, mean_with_interval(y, 0.9).error);
  EXPECT_DOUBLE_EQ(slope(x, y, equal).error, slope(x, y).error);
}

TEST(statistics, find_the_decay_that_was_put_in) {
  std::vector<double> t, y;
  for (int k = 0; k < 40; ++k) {
    t.push_back(2.0 + 0.1 * k);
    y.push_back(0.8 * std::exp(-0.1 * k / 0.7));
  }
  const Decay fit = fit_decay(t, y);
  ASSERT_TRUE(fit.found);
  EXPECT_NEAR(fit.time_constant.value, 0.7, 1e-6);  // a minimum of squares is found to the root of the rounding error
  EXPECT_NEAR(fit.amplitude, 0.8, 1e-6);
  EXPECT_NEAR(fit.residual, 0.0, 1e-7);
}

// Law: the standard error is the scatter of the fitted constants under repeated noise. 400 trials know it to 3.5 %, and the
// fit is linear to first order in noise of 2 %: 15 % hold both.
TEST(statistics, state_the_error_of_a_decay_as_large_as_it_is) {
  std::mt19937_64 random{2};
  std::normal_distribution<double> noise{0.0, 0.02};
  double squares = 0.0, stated = 0.0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> t, y;
    for (int k = 0; k < 50; ++k) {
      t.push_back(0.1 * k);
      y.push_back(std::exp(-0.1 * k / 1.5) + noise(random));
    }
    const Decay fit = fit_decay(t, y);
    ASSERT_TRUE(fit.found);
    squares += (fit.time_constant.value - 1.5) * (fit.time_constant.value - 1.5) / kTrials;
    stated += fit.time_constant.error / kTrials;
  }
  EXPECT_NEAR(stated / std::sqrt(squares), 1.0, 0.15);
}

TEST(statistics, find_no_decay_where_there_is_none) {
  const std::vector<double> t{0, 1, 2, 3, 4}, rising{1, 2, 3, 4, 5}, two{1, 2};
  EXPECT_FALSE(fit_decay(t, rising).found);
  EXPECT_FALSE(fit_decay(two, two).found);
}

// 1000 values of equal weight at the middles of 1000 equal parts of [1, 3] stand for the uniform distribution.
TEST(statistics, quantiles_of_a_uniform_distribution_lie_on_a_line) {
  std::vector<Weighted> values;
  for (int k = 999; k >= 0; --k) values.push_back({1.0 + 2.0 * (k + 0.5) / 1000.0, 2.5});
  Cumulative curve;
  curve.assign(values);
  EXPECT_NEAR(curve.quantile(0.1), 1.2, 1e-12);
  EXPECT_NEAR(curve.quantile(0.5), 2.0, 1e-12);
  EXPECT_NEAR(curve.share_below(2.8), 0.9, 1e-12);
  EXPECT_EQ(curve.quantile(0.0), values.back().value);
  EXPECT_EQ(curve.quantile(1.0), values.front().value);
  EXPECT_EQ(curve.share_below(0.5), 0.0);
}

TEST(statistics, equal_values_have_one_quantile) {
  const std::vector<Weighted> values{{2.0, 1.0}, {2.0, 3.0}, {2.0, 0.5}};
  Cumulative curve;
  curve.assign(values);
  for (const double p : {0.1, 0.5, 0.9}) EXPECT_EQ(curve.quantile(p), 2.0);
  Cumulative none;
  none.assign({});
  EXPECT_TRUE(std::isnan(none.quantile(0.5)));
}

}  // namespace
}  // namespace scree
