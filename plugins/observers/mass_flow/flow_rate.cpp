#include "flow_rate.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
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
  result.blocks = std::min(blocks, last - first);
  result.from = begin[first];
  result.to = end[last - 1];
  const double each = (result.to - result.from) / static_cast<double>(result.blocks);
  std::vector<double> rate, middle, length;
  std::size_t one = first;
  for (std::size_t b = 1; b <= result.blocks; ++b) {
    // To the end that lies nearest to where the block should end, with an interval for each block to come.
    const double wanted = result.from + each * static_cast<double>(b);
    const std::size_t latest = last - (result.blocks - b);
    std::size_t behind = one + 1;
    while (behind < latest && wanted - end[behind - 1] > end[behind] - wanted) ++behind;
    if (b == result.blocks) behind = last;
    const double sum = std::accumulate(amount.begin() + static_cast<std::ptrdiff_t>(one),
                                       amount.begin() + static_cast<std::ptrdiff_t>(behind), 0.0);
    length.push_back(end[behind - 1] - begin[one]);
    rate.push_back(sum / length.back());
    middle.push_back(0.5 * (end[behind - 1] + begin[one]));
    one = behind;
  }
  result.rate = mean_with_interval(rate, length, confidence);
  result.drift = slope(middle, rate, length);
  return result;
}

}  // namespace scree
