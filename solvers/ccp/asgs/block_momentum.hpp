// What asgs keeps of the general blocks between sweeps, as History does of the contacts.
#pragma once

#include <algorithm>
#include <vector>

#include "scree/ccp/sweep/block_sweep.hpp"

namespace scree {

/// Sums over contacts or rows.
struct AsgsSums {
  double against = 0.0;  ///< (y - x)^T d (x - x_old) [J]
  double linear = 0.0;   ///< r^T x + 1/2 x^T E x, and with a matrix 1/2 x^T v [J]
};

/// Iterate before the last pair of sweeps (with conjugate steps the start before), and where the pair started, of a BlockSweep's rows.
class BlockMomentum {
 public:
  void start(BlockSweep& blocks) {
    x_old_.assign(blocks.g().begin(), blocks.g().end());
    y_ = x_old_;
    v_old_.assign(blocks.v().begin(), blocks.v().end());
  }

  /// From x to y = x + beta (x - x_old); x becomes x_old. With a matrix v = N x goes the same way.
  void extrapolate(BlockSweep& blocks, double beta) {
    const auto go_on = [beta](std::span<double> now, std::vector<double>& old) {
      for (std::size_t i = 0; i < now.size(); ++i) {
        const double x = now[i];
        now[i] = x + beta * (x - old[i]);
        old[i] = x;
      }
    };
    go_on(blocks.g(), x_old_);
    go_on(blocks.v(), v_old_);
    std::copy(blocks.g().begin(), blocks.g().end(), y_.begin());
  }

  /// From z to y' = y + a (z - y) + b (y - y_old), of conjugate steps; y becomes y_old. Without a matrix only.
  void take_conjugate_step(BlockSweep& blocks, double a, double b) {
    const std::span<double> z = blocks.g();
    for (std::size_t i = 0; i < z.size(); ++i) {
      const double y = y_[i];
      y_[i] = z[i] = y + a * (z[i] - y) + b * (y - x_old_[i]);
      x_old_[i] = y;
    }
  }

  void undo(BlockSweep& blocks) const {
    std::copy(x_old_.begin(), x_old_.end(), blocks.g().begin());
    std::copy(v_old_.begin(), v_old_.end(), blocks.v().begin());
  }

  /// Makes v anew from the impulses `x` of the whole problem, which `blocks` has; v of x_old gets the same correction.
  void refresh(BlockSweep& blocks, std::span<const double> x) {
    const std::span<double> v = blocks.v();
    for (std::size_t i = 0; i < v.size(); ++i) v_old_[i] -= v[i];
    blocks.set_impulses(x);
    for (std::size_t i = 0; i < v.size(); ++i) v_old_[i] += v[i];
  }

  [[nodiscard]] AsgsSums sums(BlockSweep& blocks) const {
    const std::span<const double> x = blocks.g(), d = blocks.stiffness(), v = blocks.v(), e = blocks.compliance();
    AsgsSums sums;
    for (std::size_t i = 0; i < x.size(); ++i) {
      sums.against += (y_[i] - x[i]) * d[i] * (x[i] - x_old_[i]);
      sums.linear += blocks.r()[i] * x[i];
      if (!v.empty()) sums.linear += 0.5 * v[i] * x[i];
      if (!e.empty()) sums.linear += 0.5 * e[i] * x[i] * x[i];
    }
    return sums;
  }

 private:
  std::vector<double> x_old_, y_, v_old_;
};

}  // namespace scree
