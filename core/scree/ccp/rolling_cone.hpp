// The cone of a contact that resists rolling (5 rows) and spinning (6 rows), for the loops over many of them: what
// project_block() does, without branches over break points.
//
// Notation of block_cone.hpp. With n the normal part of the nearest point, part k is beyond its bound where n < ||g_k|| / mu_k.
// The derivative of what is minimised grows with n, so that its sign at that break point says on which side n lies; times mu_k:
//
//     part k beyond    <=>    d_n (||g_k|| - mu_k g_n) > sum_j d_j mu_j max(0, mu_k ||g_j|| - mu_j ||g_k||)
//
// and n follows from the parts that are beyond, in one quotient.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/problem.hpp"

namespace scree {

/// Moves `g` (kRows numbers, 5 or 6) [N s] to the nearest point of the cone of `block` in the norm of `metric`. Points of the
/// cone keep their bits.
template <std::size_t kRows>
inline void project_rolling(const CcpBlock& block, const BlockMetric& metric, double* g) {
  static_assert(kRows == 5 || kRows == 6);
  constexpr std::size_t kParts = kRows - 3;
  double mu[kParts], d[kParts], square[kParts];
  mu[0] = block.friction, d[0] = metric.tangent, square[0] = g[1] * g[1] + g[2] * g[2];
  mu[1] = block.rolling, d[1] = metric.rolling, square[1] = g[kRows - 2] * g[kRows - 2] + g[kRows - 1] * g[kRows - 1];
  if constexpr (kRows == 6) mu[2] = block.spinning, d[2] = metric.spin, square[2] = g[3] * g[3];

  double length[kParts];
  bool inside = g[0] >= 0.0;
  for (std::size_t k = 0; k < kParts; ++k) {
    length[k] = std::sqrt(square[k]);
    inside = inside && length[k] <= mu[k] * g[0];
  }
  if (inside) return;
  double numerator = metric.normal * g[0], denominator = metric.normal;
  for (std::size_t k = 0; k < kParts; ++k) {
    double others = 0.0;
    for (std::size_t j = 0; j < kParts; ++j) {
      if (j != k) others += d[j] * mu[j] * std::max(0.0, mu[k] * length[j] - mu[j] * length[k]);
    }
    const bool beyond = metric.normal * (length[k] - mu[k] * g[0]) > others;
    numerator += beyond ? d[k] * mu[k] * length[k] : 0.0;
    denominator += beyond ? d[k] * mu[k] * mu[k] : 0.0;
  }
  const double n = numerator / denominator;
  if (n <= 0.0) {
    std::fill_n(g, kRows, 0.0);
    return;
  }
  g[0] = n;
  double scale[kParts];
  for (std::size_t k = 0; k < kParts; ++k) scale[k] = length[k] <= mu[k] * n ? 1.0 : mu[k] * n / length[k];
  g[1] *= scale[0], g[2] *= scale[0];
  g[kRows - 2] *= scale[1], g[kRows - 1] *= scale[1];
  if constexpr (kRows == 6) g[3] *= scale[2];
}

}  // namespace scree
