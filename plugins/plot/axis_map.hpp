// AxisMap: from values to a strip of the page, and where its ticks are.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plot/figure.hpp"

namespace scree::plot {

/// A mark on an axis.
struct Tick {
  double value;
  std::string text;
};

/// Maps an axis onto [begin, end] of the page.
class AxisMap {
 public:
  /// `range` ascending; both ends positive for a logarithmic scale. [px] for `begin` and `end`.
  AxisMap(Scale scale, std::pair<double, double> range, double begin, double end);

  [[nodiscard]] double operator()(double value) const;
  [[nodiscard]] bool can_show(double value) const;
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  Scale scale_;
  double first_, last_;  ///< the range, as logarithms on a logarithmic scale
  double begin_, end_;
  std::vector<Tick> ticks_;
};

/// About `wanted` ticks at multiples of 1, 2 or 5 times a power of ten within [first, last].
[[nodiscard]] std::vector<Tick> linear_ticks(double first, double last, int wanted);

/// The range that shows the values: widened when they are equal, rounded to whole decades on a logarithmic scale.
[[nodiscard]] std::pair<double, double> range_of(const std::vector<double>& values, Scale scale, bool from_zero);

/// The range `least`, or a wider one that shows all values with a twentieth of their size to spare.
[[nodiscard]] std::pair<double, double> range_with(std::pair<double, double> least, const std::vector<double>& values);

}  // namespace scree::plot
