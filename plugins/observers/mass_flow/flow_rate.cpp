#include "flow_rate.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "scree/base/require.hpp"

namespace scree {

FlowRate constant_rate(std::span<const double> begin, std::span<const double> end, std::span<const double> amount,
                       double from, double to, std::size_t blocks, double confidence) {
  SCREE_REQUIRE(begin.size() == end.size() && begin.size() == amount.size(), "constant_rate: spans of equal length");
  constexpr double kRounding = 1e-9;  // of an interval
  std::size_t first = begin.size(), last = 0;
  for (std::size_t k = 0; k < begin.size(); ++k) {
    const double slack = kRounding * (end[k] - begin[k]);
    if (begin[k] < from - slack || end[k] > to + slack) continue;
    first = std::min(first, k);
    last = k + 1;
  }
  FlowRate result;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  result.rate = result.drift = {kNone, kNone};
  if (first >= last) return result;
  const std::size_t each = std::max<std::size_t>(1, (last - first) / blocks);
  result.blocks = std::min(blocks, (last - first) / each);
  first = last - result.blocks * each;
  std::vector<double> rate, middle;
  for (std::size_t b = 0; b < result.blocks; ++b) {
    const std::size_t one = first + b * each, behind = one + each;
    double sum = 0.0;
    for (std::size_t k = one; k < behind; ++k) sum += amount[k];
    rate.push_back(sum / (end[behind - 1] - begin[one]));
    middle.push_back(0.5 * (end[behind - 1] + begin[one]));
  }
  result.rate = mean_with_interval(rate, confidence);
  result.drift = slope(middle, rate);
  result.from = begin[first];
  result.to = end[last - 1];
  return result;
}

}  // namespace scree
