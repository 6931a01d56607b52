// StallWatch: when an iteration has come as far as it will.
#pragma once

#include <algorithm>
#include <limits>

namespace scree {

/// A residual falls by fits and starts, but one that converges finds new least values again and again. When the second half
/// of all iterations, and no less than kLeast, brought none, rounding is what is left (or the problem has no solution).
class StallWatch {
 public:
  static constexpr int kLeast = 1000;

  /// Takes the residual after so many iterations; true when it does not fall any more.
  bool stalled(int iteration, double residual) {
    if (residual < least_) {
      least_ = residual;
      found_ = iteration;
    }
    return iteration - found_ >= std::max(kLeast, iteration / 2);
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  int found_ = 0;
};

}  // namespace scree
