#include "splitting.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "scree/base/require.hpp"

namespace scree {

namespace {

// sums[e]: mass in front of edge e.
std::vector<double> running_sums(const std::vector<double>& masses) {
  std::vector<double> sums(masses.size() + 1, 0.0);
  std::partial_sum(masses.begin(), masses.end(), sums.begin() + 1);
  return sums;
}

}  // namespace

double grade(const ProductMass& product) { return product.all > 0.0 ? product.target / product.all : 0.0; }

double recovery(const ProductMass& product, const ProductMass& total) {
  return total.target > 0.0 ? product.target / total.target : 0.0;
}

double value(Objective objective, const ProductMass& product, const ProductMass& total) {
  if (objective == Objective::recovery_times_grade) return recovery(product, total) * grade(product);
  const double others = total.all - total.target;
  const double stray = others > 0.0 ? (product.all - product.target) / others : 0.0;
  return recovery(product, total) - stray;
}

BestSplit best_split(const StripMasses& masses, const std::vector<std::size_t>& wanted, Objective objective) {
  const std::size_t strips = masses.all.size(), products = wanted.size();
  SCREE_REQUIRE(products >= 1 && products <= strips, "every product needs a strip of the collector");
  const std::vector<double> all = running_sums(masses.all);
  std::vector<std::vector<double>> target;
  for (const auto& masses_of_target : masses.target) target.push_back(running_sums(masses_of_target));
  const auto gain = [&](std::size_t product, std::size_t from, std::size_t to) {
    if (wanted[product] == kNoTarget) return 0.0;
    const std::vector<double>& sums = target[wanted[product]];
    return value(objective, {sums[to] - sums[from], all[to] - all[from]}, {sums[strips], all[strips]});
  };

  // best[p][e]: the largest sum of the first p products when they end at edge e, and where the last of them begins.
  constexpr double kImpossible = -std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> best(products + 1, std::vector<double>(strips + 1, kImpossible));
  std::vector<std::vector<std::size_t>> begin(products + 1, std::vector<std::size_t>(strips + 1, 0));
  best[0][0] = 0.0;
  for (std::size_t p = 0; p < products; ++p) {
    for (std::size_t to = p + 1; to <= strips; ++to) {
      for (std::size_t from = p; from < to; ++from) {
        const double sum = best[p][from] + gain(p, from, to);
        if (sum > best[p + 1][to]) {
          best[p + 1][to] = sum;
          begin[p + 1][to] = from;
        }
      }
    }
  }

  BestSplit split;
  std::size_t edge = strips;
  for (std::size_t p = products; p > 1; --p) {
    edge = begin[p][edge];
    split.edges.insert(split.edges.begin(), edge);
  }
  const auto judged = static_cast<double>(
      std::count_if(wanted.begin(), wanted.end(), [](std::size_t target_index) { return target_index != kNoTarget; }));
  split.value = judged > 0.0 ? best[products][strips] / judged : 0.0;
  return split;
}

}  // namespace scree
