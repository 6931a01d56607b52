#include "scree/model/distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"
#include "scree/model/random.hpp"

namespace scree {
namespace {

Distribution from(const std::string& toml) {
  return Distribution{options_from_text("x = " + toml, {Distribution::parameter("x", "m", "a size")}).table("x")};
}

struct Moments {
  double mean;
  double deviation;
};

constexpr int kDraws = 200000;

Moments moments(const Distribution& law) {
  RandomStream random{5, "moments"};
  double sum = 0, square = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = law.sample(random);
    sum += x;
    square += x * x;
  }
  const double mean = sum / kDraws;
  return {mean, std::sqrt(square / kDraws - mean * mean)};
}

// A sample mean scatters by s / sqrt(n): five such deviations. A sample deviation scatters by at most s sqrt((k-1)/(4n)) with
// kurtosis k <= 9 for all laws here: again five.
void expect_moments(const std::string& toml, double mean, double deviation) {
  const Moments m = moments(from(toml));
  EXPECT_NEAR(m.mean, mean, 5 * deviation / std::sqrt(kDraws) + 1e-15) << toml;
  EXPECT_NEAR(m.deviation, deviation, 5 * deviation * std::sqrt(2.0 / kDraws) + 1e-9) << toml;
}

TEST(Distribution, a_plain_number_is_constant) {
  RandomStream random{1, "constant"};
  EXPECT_EQ(from("'3 mm'").sample(random), 3e-3);
}
TEST(Distribution, uniform) { expect_moments("{type = 'uniform', min = 1, max = 3}", 2.0, 2.0 / std::sqrt(12.0)); }
TEST(Distribution, normal) { expect_moments("{type = 'normal', mean = 5, deviation = 0.5}", 5.0, 0.5); }

TEST(Distribution, log_normal_has_the_textbook_moments) {
  const double s = 0.4, mean = 2.0 * std::exp(s * s / 2);
  expect_moments("{type = 'log_normal', median = 2, log_deviation = 0.4}", mean, mean * std::sqrt(std::exp(s * s) - 1));
}

TEST(Distribution, weibull_has_the_textbook_moments) {
  const double g1 = std::tgamma(1.5), g2 = std::tgamma(2.0);
  expect_moments("{type = 'weibull', scale = 3, shape = 2}", 3 * g1, 3 * std::sqrt(g2 - g1 * g1));
}

// Exponential above the least value: deviation = mean - min.
TEST(Distribution, zhang_is_a_shifted_exponential) { expect_moments("{type = 'zhang', min = 1, mean = 3}", 3.0, 2.0); }

TEST(Distribution, table_of_values_and_histogram) {
  expect_moments("{type = 'table', values = [1, 3], weights = [1, 1]}", 2.0, 1.0);
  expect_moments("{type = 'table', values = [1, 2, 3], weights = [1, 1]}", 2.0, 2.0 / std::sqrt(12.0));
}

// Half of a normal law above its mean: mean sqrt(2/pi), deviation sqrt(1 - 2/pi).
TEST(Distribution, truncation_draws_again) {
  expect_moments("{type = 'normal', mean = 0, deviation = 1, min = 0}", std::sqrt(2 / std::numbers::pi),
                 std::sqrt(1 - 2 / std::numbers::pi));
}

TEST(Distribution, contradictions_are_refused) {
  for (const char* bad :
       {"{type = 'uniform', min = 3, max = 1}", "{type = 'zhang', min = 3, mean = 1}",
        "{type = 'normal', mean = 0, deviation = 1, min = 9}", "{type = 'table', values = [1, 2], weights = [1, 2, 3]}",
        "{type = 'table', values = [1, 2], weights = [0, 0]}",
        "{type = 'table', values = [2, 1, 3], weights = [1, 1]}"}) {
    EXPECT_THROW(from(bad), Error) << bad;
  }
}

}  // namespace
}  // namespace scree
