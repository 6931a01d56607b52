#include "plot/axis_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scree::plot {

namespace {

constexpr int kTicks = 7;        // about as many on a linear axis
constexpr int kMostDecades = 9;  // ticks on a logarithmic axis

std::vector<Tick> decade_ticks(double first, double last) {
  const int low = static_cast<int>(std::ceil(first - 1e-9)), high = static_cast<int>(std::floor(last + 1e-9));
  const int stride = std::max(1, (high - low + kMostDecades) / kMostDecades);
  std::vector<Tick> ticks;
  for (int decade = low; decade <= high; decade += stride) {
    ticks.push_back({std::pow(10.0, decade), fmt::format("1e{}", decade)});
  }
  return ticks;
}

}  // namespace

std::vector<Tick> linear_ticks(double first, double last, int wanted) {
  const double rough = (last - first) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double ratio = rough / power;  // in 1..10
  const double step = power * (ratio < 1.5 ? 1.0 : (ratio < 3.5 ? 2.0 : (ratio < 7.5 ? 5.0 : 10.0)));
  const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::vector<Tick> ticks;
  const auto low = static_cast<long>(std::ceil(first / step - 1e-9));
  const auto high = static_cast<long>(std::floor(last / step + 1e-9));
  for (long k = low; k <= high; ++k) {
    const double value = static_cast<double>(k) * step;
    const bool plain = std::abs(value) < 1e5 && digits <= 5;
    ticks.push_back({value, plain ? fmt::format("{:.{}f}", k == 0 ? 0.0 : value, digits) : fmt::format("{:g}", value)});
  }
  return ticks;
}

std::pair<double, double> range_of(const std::vector<double>& values, Scale scale, bool from_zero) {
  double low = INFINITY, high = -INFINITY;
  for (const double v : values) {
    if (!std::isfinite(v) || (scale == Scale::logarithmic && v <= 0.0)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (low > high) return scale == Scale::logarithmic ? std::pair{0.1, 1.0} : std::pair{0.0, 1.0};
  if (scale == Scale::logarithmic) {
    const double first = std::floor(std::log10(low) + 1e-9), last = std::ceil(std::log10(high) - 1e-9);
    return {std::pow(10.0, first), std::pow(10.0, std::max(last, first + 1.0))};
  }
  if (from_zero && low >= 0.0) return {0.0, high > 0.0 ? 1.05 * high : 1.0};
  if (low == high) {
    const double half = low == 0.0 ? 1.0 : 0.5 * std::abs(low);
    return {low - half, high + half};
  }
  return {low, high};
}

AxisMap::AxisMap(Scale scale, std::pair<double, double> range, double begin, double end)
    : scale_{scale},
      first_{scale == Scale::linear ? range.first : std::log10(range.first)},
      last_{scale == Scale::linear ? range.second : std::log10(range.second)},
      begin_{begin},
      end_{end},
      ticks_{scale == Scale::linear ? linear_ticks(first_, last_, kTicks) : decade_ticks(first_, last_)} {}

bool AxisMap::can_show(double value) const { return std::isfinite(value) && (scale_ == Scale::linear || value > 0.0); }

double AxisMap::operator()(double value) const {
  const double v = scale_ == Scale::linear ? value : std::log10(value);
  return begin_ + (end_ - begin_) * (v - first_) / (last_ - first_);
}

std::pair<double, double> range_with(std::pair<double, double> least, const std::vector<double>& values) {
  constexpr double kSpare = 1.05;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (value > least.second) least.second = kSpare * value;
    if (value < least.first) least.first = value < 0.0 ? kSpare * value : value / kSpare;
  }
  return least;
}

}  // namespace scree::plot
