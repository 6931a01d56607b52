// Statistics that observers of flows need: fits with their errors, quantiles, and means with confidence intervals.
#pragma once

#include <span>
#include <vector>

namespace scree {

/// A value and its standard error; a NaN error when there are too few data for one.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

/// The t for which Student's distribution with `freedom` >= 1 degrees of freedom holds the share `confidence` in [-t, t]
/// (Abramowitz and Stegun, 26.7.3 and 26.7.4).
[[nodiscard]] double student_t(double confidence, std::size_t freedom);

/// The mean of independent values and the half width of its confidence interval as `error`.
[[nodiscard]] Estimate mean_with_interval(std::span<const double> values, double confidence);

/// The same of values whose variances go with the inverse of their weights, such as means over times of unequal length;
/// with equal weights it is the one above. As many weights > 0 as values.
[[nodiscard]] Estimate mean_with_interval(std::span<const double> values, std::span<const double> weights,
                                          double confidence);

/// Slope of the least-squares line and its standard error. As many x as y.
[[nodiscard]] Estimate slope(std::span<const double> x, std::span<const double> y);

/// The same of y whose variances go with the inverse of their weights.
[[nodiscard]] Estimate slope(std::span<const double> x, std::span<const double> y, std::span<const double> weights);

/// y = amplitude exp(-(t - begin) / time_constant), by nonlinear least squares over equally weighted points.
struct Decay {
  bool found = false;      ///< false for less than three points, or when the data do not decay
  double begin = 0.0;      ///< [s]
  double amplitude = 0.0;  ///< [unit of y], at `begin`
  Estimate time_constant;  ///< [s], with the standard error of the fit
  double residual = 0.0;   ///< root mean square of what is left [unit of y]
};
/// Begins at the first of `t` [s]. As many t as y.
[[nodiscard]] Decay fit_decay(std::span<const double> t, std::span<const double> y);

/// A value with a weight.
struct Weighted {
  double value = 0.0;
  double weight = 0.0;
};

/// The cumulative distribution of weighted values: each value stands in the middle of its own weight, and between values
/// the curve is straight.
class Cumulative {
 public:
  /// Takes any order; weights >= 0.
  void assign(std::span<const Weighted> values);
  /// The value below which the share `p` (0..1) of the weight lies; NaN without values.
  [[nodiscard]] double quantile(double p) const;
  /// The share of weight below a value.
  [[nodiscard]] double share_below(double value) const;
  [[nodiscard]] std::span<const Weighted> points() const {
    return points_;
  }  ///< ascending; weight: share below the value

 private:
  std::vector<Weighted> points_;
};

}  // namespace scree
