// The derivative of a projection, as the root that DirectSystem factorises with.
#pragma once

#include <span>

#include "scree/ccp/block_cone.hpp"

namespace scree::direct {

/// How the impulse p = P_T(a), a = a_0 - T^-1 u, of a block gives way to its velocity u: dp/du = -B, B = C C^T [kg]; a
/// generalised derivative (Clarke's) where the projection has a kink. `c` receives C, rows x rows by columns, those that are
/// not needed zero. T = diag(d), d the metric [1/kg]; `a` and `p` [N s], block.rows numbers.
///
/// Cones: with A the parts beyond their limits, e_k = a_k / |a_k| and S = d_n + sum_A d_k mu_k^2, the normal part is
/// n = (d_n a_n + sum_A d_k mu_k |a_k|) / S, so
///     B = q q^T / S + sum_A mu_k n / (d_k |a_k|) (I - e_k e_k^T) + sum over the other parts of I / d_k,   q = (1, mu_k e_k).
void projection_derivative(const CcpBlock& block, const BlockMetric& metric, std::span<const double> a,
                           std::span<const double> p, std::span<double> c);

/// The weight of a row of `block` [1/kg].
template <class Metric>
[[nodiscard]] auto& weight_of_row(const CcpBlock& block, Metric& metric, std::size_t row) {
  if (block.kind != CcpKind::cone || row == 0) return metric.normal;
  if (row <= 2) return metric.tangent;
  return block.rows == 6 && row == 3 ? metric.spin : metric.rolling;
}

}  // namespace scree::direct
