#include "scree/ccp/direct/projection_derivative.hpp"

#include <algorithm>
#include <cmath>

namespace scree::direct {
namespace {

/// A part of a cone that friction holds.
struct Part {
  std::size_t first = 0, count = 0;
  double coefficient = 0.0, weight = 1.0;
};

/// Columns of C, filled one after the other.
struct Root {
  std::span<double> numbers;
  std::size_t rows = 0, used = 0;

  std::span<double> next() { return numbers.subspan(rows * used++, rows); }
};

/// Columns of what a part does beside q: nothing along a, when it is beyond its limit.
void add_part(const Part& part, std::span<const double> a, double n, bool beyond, double length, Root& root) {
  if (!beyond) {
    for (std::size_t i = 0; i < part.count; ++i) root.next()[part.first + i] = 1.0 / std::sqrt(part.weight);
  } else if (part.count == 2 && length > 0.0) {
    const double along = std::sqrt(part.coefficient * n / (part.weight * length)) / length;
    const std::span<double> column = root.next();
    column[part.first] = -along * a[part.first + 1];
    column[part.first + 1] = along * a[part.first];
  }
}

void cone_derivative(const CcpBlock& block, const BlockMetric& metric, std::span<const double> a, double n,
                     Root& root) {
  const std::size_t tangents = block.rows == 2 ? 1 : 2;
  const Part parts[] = {{1, tangents, block.friction, metric.tangent},
                        {3, 1, block.spinning, metric.spin},
                        {block.rows - 2u, 2, block.rolling, metric.rolling}};
  const bool has[] = {block.rows >= 2, block.rows == 6, block.rows >= 5};
  const std::span<double> q = root.next();
  q[0] = 1.0;
  double sum = metric.normal;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!has[k]) continue;
    const Part& part = parts[k];
    double length = std::abs(a[part.first]);
    if (part.count == 2) length = std::hypot(length, a[part.first + 1]);
    const bool beyond = length > part.coefficient * n || part.coefficient == 0.0;
    if (beyond && length > 0.0) {
      sum += part.weight * part.coefficient * part.coefficient;
      for (std::size_t i = part.first; i < part.first + part.count; ++i) q[i] = part.coefficient * a[i] / length;
    }
    add_part(part, a, n, beyond, length, root);
  }
  for (double& x : q) x /= std::sqrt(sum);
}

}  // namespace

void projection_derivative(const CcpBlock& block, const BlockMetric& metric, std::span<const double> a,
                           std::span<const double> p, std::span<double> c) {
  std::ranges::fill(c, 0.0);
  Root root{c, block.rows};
  if (block.kind == CcpKind::cone) {
    if (p[0] > 0.0) cone_derivative(block, metric, a, p[0], root);
    return;
  }
  const double inside = 1.0 / std::sqrt(metric.normal);
  for (std::size_t i = 0; i < block.rows; ++i) {
    const bool moves = block.kind == CcpKind::free || (block.kind == CcpKind::nonnegative && a[i] > 0.0) ||
                       (block.kind == CcpKind::box && a[i] > block.lower && a[i] < block.upper);
    if (moves) c[i * (block.rows + 1)] = inside;
  }
}

}  // namespace scree::direct
