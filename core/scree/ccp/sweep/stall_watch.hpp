// StallWatch: when an iteration has come as far as rounding lets it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace scree {

/// A small residual may stay where it is for thousands of iterations and fall again: where N is singular, impulses travel
/// far along directions that change nothing before they meet the end of a cone. Only when it is near rounding as well,
/// beside the largest velocity of r, and the second half of all iterations brought no new least value, nothing will come.
class StallWatch {
 public:
  static constexpr int kLeast = 1000;             ///< iterations without a new least value
  static constexpr double kNearRounding = 1e-11;  ///< share of the largest velocity [1]

  explicit StallWatch(std::span<const double> r) {
    for (const double velocity : r) small_ = std::max(small_, kNearRounding * std::abs(velocity));
  }

  /// Takes the residual after so many iterations; true when it will not fall any more.
  bool stalled(int iteration, double residual) {
    if (residual < least_) {
      least_ = residual;
      found_ = iteration;
    }
    return least_ <= small_ && iteration - found_ >= std::max(kLeast, iteration / 2);
  }

 private:
  double small_ = 0.0;
  double least_ = std::numeric_limits<double>::infinity();
  int found_ = 0;
};

}  // namespace scree
