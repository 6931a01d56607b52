#include "analysis/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "scree/base/require.hpp"

namespace scree {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Share of Student's distribution in [-t, t]: a finite sum for whole degrees of freedom.
double student_share(double t, std::size_t freedom) {
  const double theta = std::atan(t / std::sqrt(static_cast<double>(freedom)));
  const double c = std::cos(theta), s = std::sin(theta);
  const bool odd = freedom % 2 == 1;
  double term = odd ? c : 1.0, sum = freedom == 1 ? 0.0 : term;
  for (std::size_t k = odd ? 3 : 2; k + 1 < freedom; k += 2) {
    const auto n = static_cast<double>(k);
    term *= c * c * (n - 1.0) / n;
    sum += term;
  }
  return odd ? 2.0 / std::numbers::pi * (theta + s * sum) : s * sum;
}

}  // namespace

double student_t(double confidence, std::size_t freedom) {
  SCREE_REQUIRE(freedom >= 1 && confidence > 0.0 && confidence < 1.0, "student_t: freedom >= 1, 0 < confidence < 1");
  double low = 0.0, high = 1.0;
  while (student_share(high, freedom) < confidence) high *= 2.0;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    (student_share(middle, freedom) < confidence ? low : high) = middle;
    if (middle == low && middle == high) break;
  }
  return 0.5 * (low + high);
}

namespace {

double weighted_mean(std::span<const double> values, std::span<const double> weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weights[i] * values[i];
  return sum / std::accumulate(weights.begin(), weights.end(), 0.0);
}

}  // namespace

Estimate mean_with_interval(std::span<const double> values, double confidence) {
  return mean_with_interval(values, std::vector<double>(values.size(), 1.0), confidence);
}

Estimate mean_with_interval(std::span<const double> values, std::span<const double> weights, double confidence) {
  SCREE_REQUIRE(values.size() == weights.size(), "mean_with_interval: as many values as weights");
  if (values.empty()) return {kNone, kNone};
  const double mean = weighted_mean(values, weights), all = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (values.size() < 2) return {mean, kNone};
  double squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) squares += weights[i] * (values[i] - mean) * (values[i] - mean);
  const auto freedom = static_cast<double>(values.size() - 1);
  return {mean, student_t(confidence, values.size() - 1) * std::sqrt(squares / freedom / all)};
}

Estimate slope(std::span<const double> x, std::span<const double> y) {
  return slope(x, y, std::vector<double>(x.size(), 1.0));
}

Estimate slope(std::span<const double> x, std::span<const double> y, std::span<const double> weights) {
  SCREE_REQUIRE(x.size() == y.size() && x.size() == weights.size(), "slope: as many x as y and weights");
  if (x.size() < 2) return {kNone, kNone};
  const double mx = weighted_mean(x, weights), my = weighted_mean(y, weights);
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += weights[i] * (x[i] - mx) * (x[i] - mx);
    xy += weights[i] * (x[i] - mx) * (y[i] - my);
  }
  if (xx <= 0.0) return {kNone, kNone};
  const double rise = xy / xx;
  double left = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = y[i] - my - rise * (x[i] - mx);
    left += weights[i] * r * r;
  }
  return {rise, x.size() > 2 ? std::sqrt(left / (static_cast<double>(x.size()) - 2.0) / xx) : kNone};
}

namespace {

/// Sums of the decay's linear part at one rate: y = a e with e = exp(-rate t).
struct AtRate {
  double amplitude = 0.0;
  double squares = 0.0;  // of the residuals
};

AtRate at_rate(std::span<const double> t, std::span<const double> y, double rate) {
  double ee = 0.0, ey = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double e = std::exp(-rate * (t[i] - t[0]));
    ee += e * e;
    ey += e * y[i];
  }
  AtRate result{ey / ee, 0.0};
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double r = y[i] - result.amplitude * std::exp(-rate * (t[i] - t[0]));
    result.squares += r * r;
  }
  return result;
}

// Standard error of the rate: sqrt of its entry in s2 (J^T J)^-1.
double rate_error(std::span<const double> t, double amplitude, double rate, double squares) {
  double aa = 0.0, ab = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double e = std::exp(-rate * (t[i] - t[0])), slope = -amplitude * (t[i] - t[0]) * e;
    aa += e * e;
    ab += e * slope;
    bb += slope * slope;
  }
  return std::sqrt(squares / (static_cast<double>(t.size()) - 2.0) * aa / (aa * bb - ab * ab));
}

}  // namespace

// The amplitude is linear, so that only the rate is searched: over decades first, then by golden section.
Decay fit_decay(std::span<const double> t, std::span<const double> y) {
  SCREE_REQUIRE(t.size() == y.size(), "fit_decay: as many t as y");
  Decay fit;
  if (t.size() < 3 || t.back() <= t.front()) return fit;
  const double span = t.back() - t.front();
  const auto squares = [&](double log_rate) { return at_rate(t, y, std::exp(log_rate)).squares; };
  const double slowest = std::log(1e-3 / span), fastest = std::log(10.0 * static_cast<double>(t.size()) / span);
  constexpr int kTries = 60;
  int best = 0;
  const auto try_at = [&](int k) { return slowest + (fastest - slowest) * k / kTries; };
  for (int k = 1; k <= kTries; ++k) {
    if (squares(try_at(k)) < squares(try_at(best))) best = k;
  }
  if (best == 0 || best == kTries) return fit;  // no decay, or over before the second point
  double low = try_at(best - 1), high = try_at(best + 1);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-9) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (squares(a) < squares(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  const double rate = std::exp(0.5 * (low + high));
  const AtRate found = at_rate(t, y, rate);
  fit.found = true;
  fit.begin = t[0];
  fit.amplitude = found.amplitude;
  fit.residual = std::sqrt(found.squares / static_cast<double>(t.size()));
  fit.time_constant = {1.0 / rate, rate_error(t, found.amplitude, rate, found.squares) / (rate * rate)};
  return fit;
}

void Cumulative::assign(std::span<const Weighted> values) {
  points_.assign(values.begin(), values.end());
  std::sort(points_.begin(), points_.end(), [](const Weighted& a, const Weighted& b) {
    return a.value != b.value ? a.value < b.value : a.weight < b.weight;
  });
  double total = 0.0, below = 0.0;
  for (const Weighted& point : points_) total += point.weight;
  for (Weighted& point : points_) {
    const double share = total > 0.0 ? point.weight / total : 0.0;
    point.weight = below + 0.5 * share;
    below += share;
  }
}

double Cumulative::quantile(double p) const {
  if (points_.empty()) return kNone;
  const auto after = std::lower_bound(points_.begin(), points_.end(), p,
                                      [](const Weighted& point, double share) { return point.weight < share; });
  if (after == points_.begin()) return points_.front().value;
  if (after == points_.end()) return points_.back().value;
  const Weighted& a = *(after - 1);
  const double part = (p - a.weight) / (after->weight - a.weight);
  return a.value + part * (after->value - a.value);
}

double Cumulative::share_below(double value) const {
  if (points_.empty()) return kNone;
  const auto after = std::upper_bound(points_.begin(), points_.end(), value,
                                      [](double v, const Weighted& point) { return v < point.value; });
  if (after == points_.begin()) return 0.0;
  if (after == points_.end()) return 1.0;
  const Weighted& a = *(after - 1);
  return a.weight + (value - a.value) / (after->value - a.value) * (after->weight - a.weight);
}

}  // namespace scree
