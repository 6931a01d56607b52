// Distribution: random sizes, densities and body attributes of a feed, as a scene describes them.
//
//     size = "2 mm"                                                      # constant
//     size = { type = "uniform", min = "0.7 mm", max = "3 mm" }
//     size = { type = "table", values = [1e-3, 2e-3, 4e-3], weights = [3, 1] }   # histogram between the values
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scree/config/parameter.hpp"

namespace scree {

class Options;
class RandomStream;

/// A law to draw numbers from. A value type.
class Distribution {
 public:
  /// The parameter of a setting that may be a plain number or a distribution with values of `unit`.
  static Parameter parameter(std::string name, std::string unit, std::string help);
  /// The alternatives of such a setting, for `columns` of them.
  static std::vector<Variant> variants(const std::string& unit);

  /// Always `value`.
  explicit Distribution(double value = 0.0);
  /// From a validated variant of parameter(). @throws Error (usage) when the numbers contradict each other.
  explicit Distribution(const Options& options);

  /// Draws one value. Truncated laws draw again until the value lies within their bounds.
  [[nodiscard]] double sample(RandomStream& random) const { return draw_(random); }
  /// Bounds of what sample() can return; infinite where the law is.
  [[nodiscard]] double minimum() const { return minimum_; }
  [[nodiscard]] double maximum() const { return maximum_; }

 private:
  std::function<double(RandomStream&)> draw_;
  double minimum_;  // [unit of the setting]
  double maximum_;  // [unit of the setting]
};

}  // namespace scree
