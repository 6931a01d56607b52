#include "scree/ccp/sweep/block_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scree/ccp/block_rows.hpp"

namespace scree::sweep {
namespace {

constexpr std::size_t kMost = CcpBlock::kMostRows;
using Rows = BlockVector;

/// Rows whose own stiffness, beside that of the rows they depend on, is less than this share of it are left out.
constexpr double kDependent = 1e-12;
constexpr int kConeSteps = 4;

/// A of block k without compliance, as BlockSteps::bind() describes it.
void fill_part(const CcpProblem& problem, std::size_t k, std::span<const double> body_weights, std::span<double> a) {
  CcpProblem part = problem;
  part.compliance = {};
  if (body_weights.empty()) return diagonal_block_of_block(part, k, a);
  // The same block between two bodies that are lighter by their weights. (One body alone on both sides stays one.)
  CcpBlock block = problem.blocks[k];
  const std::array<std::uint32_t, 2> bodies{block.a, block.b};
  std::array<double, 2> mass{};
  std::array<Mat3, 2> inertia;
  for (std::size_t side = 0; side < 2; ++side) {
    const double weight = body_weights[bodies[side]];
    const Mat3& j = problem.inverse_inertia[bodies[side]];
    mass[side] = weight * problem.inverse_mass[bodies[side]];
    inertia[side] = {weight * j.row0, weight * j.row1, weight * j.row2};
  }
  part.block_rows = jacobian_of(problem, block);
  block.b = block.a == block.b ? 0 : 1;
  block.a = 0;
  block.first_row = 0;
  part.contacts = {};
  part.inverse_mass = mass;
  part.inverse_inertia = inertia;
  part.blocks = {&block, 1};
  diagonal_block_of_block(part, 0, a);
}

/// Replaces symmetric positive semi-definite `a` (n x n) by a matrix G with a G a = a, up to rounding: the inverse of the
/// largest part of it that is well defined, zeros beside it. Gauss-Jordan elimination, greatest pivot first.
void invert(std::span<double> a, std::size_t n) {
  Rows diagonal{};
  std::array<bool, kMost> done{};
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = a[i * n + i];
  for (std::size_t step = 0; step < n; ++step) {
    std::size_t p = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (!done[i] && a[i * n + i] > kDependent * diagonal[i] && (p == n || a[i * n + i] > a[p * n + p])) p = i;
    }
    if (p == n) break;
    done[p] = true;
    const double inverse = 1.0 / a[p * n + p];
    for (std::size_t i = 0; i < n; ++i) {
      if (i == p) continue;
      const double factor = a[i * n + p] * inverse;
      for (std::size_t j = 0; j < n; ++j) {
        if (j != p) a[i * n + j] -= factor * a[p * n + j];
      }
      a[i * n + p] = -factor;
    }
    for (std::size_t j = 0; j < n; ++j) a[p * n + j] *= inverse;
    a[p * n + p] = inverse;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (!done[i] || !done[j]) a[i * n + j] = 0.0;
    }
  }
}

/// Rows of a cone that one weight of the metric is for.
struct Part {
  std::size_t first = 0, count = 1;
  double BlockMetric::*weight = &BlockMetric::normal;
  double coefficient = 1.0;
};

struct Parts {
  std::array<Part, 4> list;
  std::size_t count = 0;
};

Parts parts_of(const CcpBlock& block) {
  Parts parts{{Part{}}, 1};
  const std::size_t tangents = block.rows == 2 ? 1 : 2;
  if (block.rows >= 2) parts.list[parts.count++] = {1, tangents, &BlockMetric::tangent, block.friction};
  if (block.rows == 6) parts.list[parts.count++] = {3, 1, &BlockMetric::spin, block.spinning};
  if (block.rows >= 5) parts.list[parts.count++] = {block.rows - 2u, 2, &BlockMetric::rolling, block.rolling};
  return parts;
}

/// The largest singular value of the part (p, q) of `a`, at most 2 x 2.
double norm_of(std::span<const double> a, std::size_t n, const Part& p, const Part& q) {
  const auto at = [&](std::size_t i, std::size_t j) {
    return i < p.count && j < q.count ? a[(p.first + i) * n + q.first + j] : 0.0;
  };
  const double squares = at(0, 0) * at(0, 0) + at(0, 1) * at(0, 1) + at(1, 0) * at(1, 0) + at(1, 1) * at(1, 1);
  const double determinant = at(0, 0) * at(1, 1) - at(0, 1) * at(1, 0);
  const double root = std::sqrt(std::max(0.0, squares * squares - 4.0 * determinant * determinant));
  return std::sqrt(0.5 * (squares + root));
}

double& of_row(BlockMetric& metric, const CcpBlock& block, std::size_t row) {
  if (row == 0) return metric.normal;
  if (row <= 2) return metric.tangent;
  return block.rows == 6 && row == 3 ? metric.spin : metric.rolling;
}

}  // namespace

BlockMetric bounding_metric(const CcpBlock& block, std::span<const double> a) {
  const Parts parts = parts_of(block);
  const std::size_t n = block.rows, m = parts.count;
  std::array<std::array<double, 4>, 4> c{};
  std::array<double, 4> own{}, w{1.0, 1.0, 1.0, 1.0}, next{};
  for (std::size_t p = 0; p < m; ++p) own[p] = norm_of(a, n, parts.list[p], parts.list[p]);
  for (std::size_t p = 0; p < m; ++p) {
    for (std::size_t q = 0; q < m; ++q) {
      const bool coupled = p != q && parts.list[p].coefficient > 0.0 && parts.list[q].coefficient > 0.0;
      const double product = own[p] * own[q];
      if (!coupled || !(product > 0.0)) continue;
      const double there = norm_of(a, n, parts.list[p], parts.list[q]),
                   back = norm_of(a, n, parts.list[q], parts.list[p]);
      c[p][q] = std::max(there, back) / std::sqrt(product);
    }
    c[p][p] = 1.0;
  }
  // Any w gives a bound, a few powers of C a good one.
  for (int step = 0; step < 8; ++step) {
    for (std::size_t p = 0; p < m; ++p) {
      next[p] = 0.0;
      for (std::size_t q = 0; q < m; ++q) next[p] += c[p][q] * w[q];
    }
    if (step == 7) break;
    const double largest = *std::max_element(next.begin(), next.begin() + static_cast<std::ptrdiff_t>(m));
    for (std::size_t p = 0; p < m; ++p) w[p] = next[p] / largest;
  }
  BlockMetric metric{};
  double largest = 0.0;
  for (std::size_t p = 0; p < m; ++p)
    largest = std::max(largest, metric.*parts.list[p].weight = own[p] * next[p] / w[p]);
  // A part that nothing resists goes to the end of what friction allows; its weight must not be zero.
  for (std::size_t p = 0; p < m; ++p) {
    double& d = metric.*parts.list[p].weight;
    d = largest > 0.0 ? std::max(d, 1e-9 * largest) : 1.0;
  }
  return metric;
}

void BlockSteps::bind(const CcpProblem& problem, const StepSettings& settings, std::span<const double> body_weights,
                      std::span<const double> block_weights) {
  blocks_ = problem.blocks;
  relaxation_ = settings.relaxation;
  cone_steps_ = settings.relaxation == 1.0 && !settings.scalar_step ? kConeSteps : 1;
  first_.resize(blocks_.size() + 1);
  first_[0] = 0;
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    first_[k + 1] = first_[k] + std::size_t{blocks_[k].rows} * blocks_[k].rows;
  matrices_.assign(first_.back(), 0.0);
  stiffness_.assign(problem.rows() - problem.contact_rows(), 0.0);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const std::size_t n = blocks_[k].rows, row = first_row(problem, blocks_[k]);
    const std::span<double> a{matrices_.data() + first_[k], n * n};
    fill_part(problem, k, body_weights, a);
    for (double& x : a) x *= block_weights.empty() ? 1.0 : block_weights[k];
    for (std::size_t i = 0; i < n && !problem.compliance.empty(); ++i) a[i * n + i] += problem.compliance[row + i];
    prepare(k, settings);
  }
}

void BlockSteps::prepare(std::size_t k, const StepSettings& settings) {
  const CcpBlock& block = blocks_[k];
  const std::size_t n = block.rows;
  const std::span<double> a{matrices_.data() + first_[k], n * n};
  double trace = 0.0;
  for (std::size_t i = 0; i < n; ++i) trace += stiffness_[block.first_row + i] = a[i * n + i];
  if (block.kind == CcpKind::free) return invert(a, n);
  if (block.kind != CcpKind::cone || !(trace > 0.0)) return;
  BlockMetric metric = bounding_metric(block, a);
  if (settings.scalar_step) {
    // The mean may lie below half the largest eigenvalue: steps would then overshoot and diverge.
    const double largest = std::max(
        {metric.normal, n > 1 ? metric.tangent : 0.0, n > 5 ? metric.spin : 0.0, n > 4 ? metric.rolling : 0.0});
    const double d = std::max(trace / static_cast<double>(n), 0.55 * settings.relaxation * largest);
    metric = {d, d, d, d};
  }
  for (std::size_t i = 0; i < n; ++i) stiffness_[block.first_row + i] = of_row(metric, block, i);
}

void BlockSteps::advance(std::size_t k, std::span<const double> u, std::span<double> g) const {
  const CcpBlock& block = blocks_[k];
  if (block.kind == CcpKind::cone) return advance_cone(k, u, g);
  if (block.kind != CcpKind::free) return advance_rows(k, u, g);
  const std::size_t n = block.rows;
  const double* const inverse = matrices_.data() + first_[k];
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) g[i] -= relaxation_ * inverse[i * n + j] * u[j];
  }
}

void BlockSteps::advance_rows(std::size_t k, std::span<const double> u, std::span<double> g) const {
  const CcpBlock& block = blocks_[k];
  const std::size_t n = block.rows;
  const double* const a = matrices_.data() + first_[k];
  const bool box = block.kind == CcpKind::box;
  const double lower = box ? block.lower : 0.0, upper = box ? block.upper : std::numeric_limits<double>::infinity();
  Rows v{};
  std::copy(u.begin(), u.end(), v.begin());
  for (std::size_t i = 0; i < n; ++i) {
    const double stiffness = a[i * n + i];
    double next = g[i];
    if (stiffness > 0.0) {
      next = std::clamp(g[i] - relaxation_ * v[i] / stiffness, lower, upper);
    } else if (v[i] != 0.0 && std::isfinite(v[i] > 0.0 ? lower : upper)) {
      next = v[i] > 0.0 ? lower : upper;  // nothing resists: to the end
    }
    const double change = next - g[i];
    g[i] = next;
    for (std::size_t j = 0; j < n; ++j) v[j] += a[j * n + i] * change;
  }
}

void BlockSteps::advance_cone(std::size_t k, std::span<const double> u, std::span<double> g) const {
  const CcpBlock& block = blocks_[k];
  const std::size_t n = block.rows;
  const double* const a = matrices_.data() + first_[k];
  const double* const d = stiffness_.data() + block.first_row;
  if (!(d[0] > 0.0)) return;  // two immovable bodies
  const BlockMetric metric{d[0], n > 1 ? d[1] : 1.0, n == 6 ? d[3] : 1.0, n > 4 ? d[n - 1] : 1.0};
  Rows v{};
  std::copy(u.begin(), u.end(), v.begin());
  double first_change = 0.0;
  for (int step = 0; step < cone_steps_; ++step) {
    Rows trial{};
    for (std::size_t i = 0; i < n; ++i) trial[i] = g[i] - relaxation_ * v[i] / d[i];
    project_block(block, metric, {trial.data(), n});
    double change = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double moved = trial[i] - g[i];
      change += d[i] * moved * moved;
      for (std::size_t j = 0; j < n; ++j) v[j] += a[i * n + j] * moved;  // A is symmetric
      g[i] = trial[i];
    }
    if (step == 0) first_change = change;
    if (change <= kSmallChange * first_change) break;
  }
}

}  // namespace scree::sweep
