// A root of a small positive definite matrix, and of its inverse, from the rows whose squares make the matrix.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "scree/ccp/problem.hpp"

namespace scree::second_order {

/// h = R^T R, grown row by row: h += x x^T. Rotations (Givens) keep the digits of small and large rows alike, where the sum h
/// itself would lose the small ones.
class SmallRoot {
 public:
  using Row = std::array<double, CcpBlock::kMostRows>;

  explicit SmallRoot(std::size_t n) : n_{n} {}

  void add(Row x) {
    for (std::size_t j = 0; j < n_; ++j) {
      if (x[j] == 0.0) continue;
      const double length = std::hypot(r_[j][j], x[j]);
      const double c = r_[j][j] / length, s = x[j] / length;
      for (std::size_t k = j; k < n_; ++k) {
        const double above = r_[j][k];
        r_[j][k] = c * above + s * x[k];
        x[k] = c * x[k] - s * above;
      }
    }
  }

  /// R, n x n by columns.
  void store(std::span<double> out) const {
    for (std::size_t j = 0; j < n_; ++j) {
      for (std::size_t i = 0; i < n_; ++i) out[j * n_ + i] = i <= j ? r_[i][j] : 0.0;
    }
  }
  /// R^-1, n x n by columns.
  void store_inverse(std::span<double> out) const {
    for (std::size_t j = 0; j < n_; ++j) {
      for (std::size_t i = n_; i-- > 0;) {
        double sum = i == j ? 1.0 : 0.0;
        for (std::size_t k = i + 1; k <= j && k < n_; ++k) sum -= r_[i][k] * out[j * n_ + k];
        out[j * n_ + i] = i <= j ? sum / r_[i][i] : 0.0;
      }
    }
  }

 private:
  std::size_t n_;
  std::array<Row, CcpBlock::kMostRows> r_{};
};

}  // namespace scree::second_order
