#include "contact_study/log_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scree/base/error.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

LogHistogram::LogHistogram(double lower, double upper, int per_decade) {
  const auto bins = static_cast<int>(std::ceil(std::log10(upper / lower) * per_decade - 1e-9));
  for (int k = 0; k <= bins; ++k) edges_.push_back(lower * std::pow(10.0, static_cast<double>(k) / per_decade));
  counts_.assign(edges_.size() + 1, 0);
  weights_.assign(edges_.size() + 1, 0.0);
}

void LogHistogram::add(double quantity, double weight) {
  const auto above = std::upper_bound(edges_.begin(), edges_.end(), quantity);
  const auto k = static_cast<std::size_t>(above - edges_.begin());  // 0: below, edges: above
  ++counts_[k];
  weights_[k] += weight;
}

std::uint64_t LogHistogram::total_count() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

double LogHistogram::total_weight() const { return std::accumulate(weights_.begin(), weights_.end(), 0.0); }

void LogHistogram::save(StateWriter& out) const {
  out.write("counts", std::span<const std::uint64_t>{counts_});
  out.write("weights", std::span<const double>{weights_});
}

void LogHistogram::load(const StateReader& in) {
  std::vector<std::uint64_t> counts = in.integers("counts");
  if (counts.size() != counts_.size()) {
    throw Error{ErrorKind::io, "the checkpoint has other bins than the scene; resume with the scene that wrote it"};
  }
  counts_ = std::move(counts);
  weights_ = in.doubles("weights");
}

}  // namespace scree
