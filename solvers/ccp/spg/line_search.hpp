// The non-monotone line search of Grippo, Lampariello, Lucidi (1986) on a quadratic, with the safeguards of Birgin, Martinez,
// Raydan (2000), algorithm 2.1.
//
// Glossary: f, the objective [J]; s = grad f . d < 0, the slope along a direction d [J]; c = d^T N d >= 0, the curvature [J];
// lambda, the step along d [1], accepted when
//
//     f(x + lambda d) <= max of f over the last `memory` iterates + 1e-4 lambda s
//
// On a quadratic f(x + lambda d) - f(x) = lambda s + lambda^2 c / 2: no trial costs a product. Objectives are kept as
// differences from that of the present iterate, so that the test works down to the last bits of a step, however large f.
#pragma once

#include <algorithm>
#include <vector>

namespace scree::spg {

/// Keeps the objectives of the last iterates, and its memory between solves.
class LineSearch {
 public:
  /// Forgets everything; `memory` >= 1 iterates count, 1 makes the search monotone.
  void start(int memory) {
    above_.assign(static_cast<std::size_t>(memory), 0.0);
    next_ = 0;
    change_ = 0.0;
    reductions_ = 0;
  }

  /// The step along a direction of slope < 0 and curvature >= 0 [J]; the iterate is taken to move there. Trials shrink by a
  /// factor between 0.1 and 0.9, to the minimum of the parabola where that lies between.
  double step(double slope, double curvature) {
    constexpr double kEnough = 1e-4;
    const double highest = *std::max_element(above_.begin(), above_.end());
    double lambda = 1.0;
    const auto change = [&] { return lambda * slope + 0.5 * lambda * lambda * curvature; };
    while (change() > highest + kEnough * lambda * slope) {
      lambda = std::clamp(-slope / curvature, 0.1 * lambda, 0.9 * lambda);
      ++reductions_;
    }
    const double moved = change();
    for (double& above : above_) above -= moved;
    next_ = (next_ + 1) % above_.size();
    above_[next_] = 0.0;
    change_ += moved;
    return lambda;
  }

  /// f of the iterate less that at the start [J].
  [[nodiscard]] double change() const { return change_; }
  /// Trials refused since the start.
  [[nodiscard]] int reductions() const { return reductions_; }

 private:
  std::vector<double> above_;  ///< f of the last iterates less that of the present one [J], a ring
  std::size_t next_ = 0;       ///< the present one
  double change_ = 0.0;
  int reductions_ = 0;
};

}  // namespace scree::spg
