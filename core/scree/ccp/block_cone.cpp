#include "scree/ccp/block_cone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scree/base/require.hpp"
#include "scree/ccp/rolling_cone.hpp"

namespace scree {
namespace {

/// A part of a cone that friction holds: rows first .. first + count - 1.
struct Part {
  std::size_t first = 0, count = 0;
  double coefficient = 0.0;
  double weight = 1.0;
  double length = 0.0;  ///< of the part of g
};

struct Parts {
  std::array<Part, 3> list;
  std::size_t count = 0;

  void add(const Part& part) { list[count++] = part; }
  [[nodiscard]] std::span<Part> all() & { return {list.data(), count}; }
};

double length_of(std::span<const double> x) {
  if (x.size() == 1) return std::abs(x[0]);
  return std::sqrt(x[0] * x[0] + x[1] * x[1]);
}

/// The parts of a cone, with their lengths in `g`.
Parts parts_of(const CcpBlock& block, const BlockMetric& metric, std::span<const double> g) {
  Parts parts;
  if (block.rows >= 2) parts.add({1, block.rows == 2 ? 1u : 2u, block.friction, metric.tangent});
  if (block.rows == 6) parts.add({3, 1, block.spinning, metric.spin});
  if (block.rows >= 5) parts.add({block.rows - 2u, 2, block.rolling, metric.rolling});
  for (Part& part : parts.all()) part.length = length_of(g.subspan(part.first, part.count));
  return parts;
}

/// The normal part of the nearest point. Sums are made anew for every break point: what is left may be far smaller than
/// what falls away.
double nearest_normal(std::span<const Part> parts, double d_n, double g_n) {
  std::array<bool, 3> beyond{};
  for (std::size_t k = 0; k < parts.size(); ++k) beyond[k] = parts[k].coefficient > 0.0 && parts[k].length > 0.0;
  for (;;) {
    double numerator = d_n * g_n, denominator = d_n;
    double break_point = std::numeric_limits<double>::infinity();
    std::size_t next = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (!beyond[k]) continue;
      const Part& part = parts[k];
      numerator += part.weight * part.coefficient * part.length;
      denominator += part.weight * part.coefficient * part.coefficient;
      const double at = part.length / part.coefficient;
      if (at < break_point) break_point = at, next = k;
    }
    const double n = numerator / denominator;
    if (!(n > break_point)) return n;  // also when it is not a number
    beyond[next] = false;
  }
}

void project_cone(const CcpBlock& block, const BlockMetric& metric, std::span<double> g) {
  if (block.rows == 6) return project_rolling<6>(block, metric, g.data());
  if (block.rows == 5) return project_rolling<5>(block, metric, g.data());
  Parts parts = parts_of(block, metric, g);
  const auto within = [&](const Part& part) { return part.length <= part.coefficient * g[0]; };
  if (g[0] >= 0.0 && std::all_of(parts.all().begin(), parts.all().end(), within)) return;
  const double n = nearest_normal(parts.all(), metric.normal, g[0]);
  if (n <= 0.0) {
    std::fill(g.begin(), g.end(), 0.0);
    return;
  }
  g[0] = n;
  for (const Part& part : parts.all()) {
    if (part.length <= part.coefficient * n) continue;
    const double scale = part.coefficient * n / part.length;
    for (double& x : g.subspan(part.first, part.count)) x *= scale;
  }
}

}  // namespace

void project_block(const CcpBlock& block, std::span<double> g) { project_block(block, BlockMetric{}, g); }

void project_block(const CcpBlock& block, const BlockMetric& metric, std::span<double> g) {
  SCREE_ASSERT(g.size() == block.rows);
  switch (block.kind) {
    case CcpKind::free:
      return;
    case CcpKind::nonnegative:
      for (double& x : g) x = std::max(x, 0.0);
      return;
    case CcpKind::box:
      for (double& x : g) x = std::clamp(x, block.lower, block.upper);
      return;
    case CcpKind::cone:
      project_cone(block, metric, g);
      return;
  }
}

double dissipation_rate(const CcpBlock& block, std::span<const double> u) {
  if (block.kind != CcpKind::cone) return 0.0;
  Parts parts = parts_of(block, {}, u);
  double sum = 0.0;
  for (const Part& part : parts.all()) sum += part.coefficient * part.length;
  return sum;
}

double violation(const CcpBlock& block, std::span<const double> g) {
  double worst = -std::numeric_limits<double>::infinity();
  Parts parts;
  switch (block.kind) {
    case CcpKind::free:
      break;
    case CcpKind::nonnegative:
      for (const double x : g) worst = std::max(worst, -x);
      break;
    case CcpKind::box:
      for (const double x : g) worst = std::max({worst, block.lower - x, x - block.upper});
      break;
    case CcpKind::cone:
      worst = -g[0];
      parts = parts_of(block, {}, g);
      for (const Part& part : parts.all()) {
        worst = std::max(worst, part.length - part.coefficient * g[0]);
      }
      break;
  }
  return worst;
}

}  // namespace scree
