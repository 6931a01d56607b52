#include "residence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {

Residence residence_of(std::span<const Weighted> times) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Residence r;
  r.count = times.size();
  double squared_weights = 0.0, sum = 0.0;
  for (const Weighted& time : times) {
    r.weight += time.weight;
    squared_weights += time.weight * time.weight;
    sum += time.weight * time.value;
  }
  r.mean = r.weight > 0.0 ? sum / r.weight : kNone;
  for (const Weighted& time : times)
    r.variance += time.weight * (time.value - r.mean) * (time.value - r.mean) / r.weight;
  const double effective = r.weight * r.weight / squared_weights;  // as many bodies of equal weight know as much
  r.variance = effective > 1.0 ? r.variance * effective / (effective - 1.0) : kNone;
  r.error = std::sqrt(r.variance / effective);
  r.tanks = r.mean * r.mean / r.variance;
  Cumulative curve;
  curve.assign(times);
  r.t10 = curve.quantile(0.1);
  r.t50 = curve.quantile(0.5);
  r.t90 = curve.quantile(0.9);
  return r;
}

std::vector<double> density_of(std::span<const Weighted> times, std::span<const double> edges) {
  std::vector<double> density(edges.size() - 1, 0.0);
  double all = 0.0;
  for (const Weighted& time : times) {
    all += time.weight;
    const auto after = std::upper_bound(edges.begin(), edges.end(), time.value) - edges.begin();
    const auto bin =
        std::min<std::ptrdiff_t>(after, static_cast<std::ptrdiff_t>(density.size())) - 1;  // the last edge counts
    if (bin >= 0 && time.value <= edges.back()) density[static_cast<std::size_t>(bin)] += time.weight;
  }
  for (std::size_t b = 0; b < density.size(); ++b) density[b] /= all * (edges[b + 1] - edges[b]);
  return density;
}

double tanks_in_series(double t, double mean, double tanks) {
  const double s = mean / tanks;
  if (t <= 0.0) return tanks > 1.0 ? 0.0 : 1.0 / s;
  return std::exp((tanks - 1.0) * std::log(t / s) - t / s - std::lgamma(tanks)) / s;
}

}  // namespace scree
