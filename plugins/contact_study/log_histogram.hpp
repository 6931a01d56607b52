// LogHistogram: amounts by the order of a positive quantity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scree {

class StateReader;
class StateWriter;

/// Bins of equal width in the logarithm; what is below or above the range has a bin of its own.
class LogHistogram {
 public:
  LogHistogram() = default;
  /// @param lower, upper [unit of the quantity], 0 < lower < upper; bins have `per_decade` to a factor of ten, the last one
  /// reaches `upper` or farther.
  LogHistogram(double lower, double upper, int per_decade);

  /// Counts one of `quantity`, with the amount of `weight`. What is zero or less is below.
  void add(double quantity, double weight);

  /// Bins within the range.
  [[nodiscard]] std::size_t bins() const { return edges_.empty() ? 0 : edges_.size() - 1; }
  [[nodiscard]] const std::vector<double>& edges() const { return edges_; }
  /// Number and weight of bin k; of what is below and above.
  [[nodiscard]] std::uint64_t count(std::size_t k) const { return counts_[k + 1]; }
  [[nodiscard]] double weight(std::size_t k) const { return weights_[k + 1]; }
  [[nodiscard]] std::uint64_t below() const { return counts_.front(); }
  [[nodiscard]] std::uint64_t above() const { return counts_.back(); }
  [[nodiscard]] std::uint64_t total_count() const;
  [[nodiscard]] double total_weight() const;

  void save(StateWriter& out) const;
  /// @throws Error (io) when the state has other bins.
  void load(const StateReader& in);

 private:
  std::vector<double> edges_;
  std::vector<std::uint64_t> counts_;  // below, bins, above
  std::vector<double> weights_;        // the same
};

}  // namespace scree
