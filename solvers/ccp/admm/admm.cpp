#include "admm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/block_cone.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {
namespace {

/// Rows without bounds need no pulling together: their x is their z but for this share of the penalty.
constexpr double kFreeShare = 1e-2;
/// The primal residual may be so many times the dual one: measured on settled beds, where balance at 1 takes far longer.
constexpr double kBalance = 10.0;
/// rho changes when it should be so many times larger or smaller; by at most so much at a time.
constexpr double kImbalance = 3.0, kMostChange = 10.0;
constexpr double kLeastPenalty = 1e-6, kMostPenalty = 1e6;

}  // namespace

Admm::Admm(const Options& options)
    : Admm{AdmmOptions{.penalty = options.number("penalty"),
                       .relaxation = options.number("relaxation"),
                       .balance_interval = static_cast<int>(options.integer("balance_interval")),
                       .most_factorisations = static_cast<int>(options.integer("most_factorisations")),
                       .check_interval = static_cast<int>(options.integer("check_interval"))}} {}

std::vector<Parameter> Admm::parameters() {
  return {
      Parameter::number("penalty", "1", "pull between dynamics and cones at first, in terms of each contact's own mass")
          .by_default(0.1)
          .at_least(kLeastPenalty)
          .at_most(kMostPenalty),
      Parameter::number("relaxation", "1", "over-relaxation of the impulses; 1 for none")
          .by_default(1.6)
          .at_least(0.1)
          .at_most(1.95),
      Parameter::integer("balance_interval", "iterations between two looks at whether the penalty should change")
          .by_default(20)
          .at_least(1.0),
      Parameter::integer("most_factorisations", "factorisations in one solve, the first and those for a new penalty")
          .by_default(30)
          .at_least(1.0),
      Parameter::integer("check_interval", "iterations between two computations of the residual")
          .by_default(5)
          .at_least(1.0),
  };
}

void Admm::prepare(const CcpProblem& problem, std::span<const double> gamma) {
  problem_ = &problem;
  system_.bind(problem);
  weight_.assign(best_.traces().begin(), best_.traces().end());
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const CcpBlock& unit = system_.units()[i];
    weight_[i] *= (unit.kind == CcpKind::free ? kFreeShare : 1.0) / unit.rows;
  }
  x_.assign(gamma.begin(), gamma.end());
  z_ = x_;
  rhs_.assign(problem.rows(), 0.0);
  product_.assign(problem.rows(), 0.0);
  c_.assign(system_.block_numbers(), 0.0);
  // y = -P*(u), as it would be if the guess were the answer: the part of -u that pulls out of the cone.
  std::vector<double>& u = y_;
  u.resize(problem.rows());
  best_.velocities_of_guess(u);
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const CcpBlock& unit = system_.units()[i];
    if (weight_[i] == 0.0) continue;
    std::array<double, CcpBlock::kMostRows> pulled{};
    for (std::size_t row = 0; row < unit.rows; ++row) {
      pulled[row] = z_[unit.first_row + row] - u[unit.first_row + row] / weight_[i];
    }
    std::array<double, CcpBlock::kMostRows> projected = pulled;
    project_block(unit, std::span{projected}.first(unit.rows));
    for (std::size_t row = 0; row < unit.rows; ++row) {
      y_[unit.first_row + row] = weight_[i] * (pulled[row] - projected[row]);
    }
  }
  factorisations_ = 0;
}

bool Admm::factor(double rho) {
  rho_ = rho;
  ++factorisations_;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const CcpBlock& unit = system_.units()[i];
    for (std::size_t row = 0; row < unit.rows && weight_[i] > 0.0; ++row) {
      const double e = problem_->compliance.empty() ? 0.0 : problem_->compliance[unit.first_row + row];
      c_[system_.block_at(i) + row * (std::size_t{unit.rows} + 1)] = 1.0 / std::sqrt(rho * weight_[i] + e);
    }
  }
  return system_.factor(c_);
}

// x_ = (N + S)^-1 rhs_.
void Admm::solve_dynamics() {
  if (problem_->matrix.empty()) return system_.solve_regularised(rhs_, x_);
  // A matrix that is given may be symmetric to a few digits only, and its factor is that of one triangle: what the last x
  // leaves is corrected, so that the iteration ends where the matrix itself is solved.
  system_.velocities(x_, product_);
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const CcpBlock& unit = system_.units()[i];
    for (std::size_t k = unit.first_row; k < unit.first_row + unit.rows; ++k) {
      const double e = problem_->compliance.empty() ? 0.0 : problem_->compliance[k];
      product_[k] = rhs_[k] - product_[k] - (rho_ * weight_[i] + e) * x_[k];
    }
  }
  system_.solve_regularised(product_, rhs_);
  for (std::size_t k = 0; k < x_.size(); ++k) x_[k] += rhs_[k];
}

Admm::Residuals Admm::iterate() {
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const CcpBlock& unit = system_.units()[i];
    for (std::size_t k = unit.first_row; k < unit.first_row + unit.rows; ++k) {
      rhs_[k] = weight_[i] > 0.0 ? rho_ * weight_[i] * z_[k] - y_[k] - problem_->r[k] : 0.0;
    }
  }
  solve_dynamics();
  Residuals out;
  for (std::size_t i = 0; i < weight_.size(); ++i) {
    const CcpBlock& unit = system_.units()[i];
    if (weight_[i] == 0.0) continue;
    const double s = rho_ * weight_[i];
    std::array<double, CcpBlock::kMostRows> next{};
    for (std::size_t row = 0, k = unit.first_row; row < unit.rows; ++row, ++k) {
      next[row] = options_.relaxation * x_[k] + (1.0 - options_.relaxation) * z_[k] + y_[k] / s;
    }
    const std::array<double, CcpBlock::kMostRows> pulled = next;
    project_block(unit, std::span{next}.first(unit.rows));
    double apart = 0.0, moved = 0.0;
    for (std::size_t row = 0, k = unit.first_row; row < unit.rows; ++row, ++k) {
      y_[k] = s * (pulled[row] - next[row]);
      apart += (x_[k] - next[row]) * (x_[k] - next[row]);
      moved += (z_[k] - next[row]) * (z_[k] - next[row]);
      z_[k] = next[row];
    }
    out.primal = std::max(out.primal, weight_[i] * std::sqrt(apart));
    out.dual = std::max(out.dual, s * std::sqrt(moved));
  }
  return out;
}

// Another penalty when the residuals are far apart; y is a velocity and stays. False when it cannot be factorised.
bool Admm::balance(const Residuals& residuals) {
  if (factorisations_ >= options_.most_factorisations) return true;
  const double ratio = std::sqrt(residuals.primal / (kBalance * residuals.dual));
  if (!std::isfinite(ratio) || (ratio < kImbalance && ratio > 1.0 / kImbalance)) return true;
  const double rho = std::clamp(rho_ * std::clamp(ratio, 1.0 / kMostChange, kMostChange), kLeastPenalty, kMostPenalty);
  return rho == rho_ || factor(rho);
}

SolveSummary Admm::solve(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "admm: gamma needs one number a row");
  if (problem.empty()) return {};
  if (!best_.start(problem, context, gamma)) {
    return {SolveStatus::numerical_failure, 0, std::numeric_limits<double>::infinity()};
  }
  SolveSummary summary{SolveStatus::iteration_limit, 0, 0.0};
  bool sound = true;
  if (!best_.done()) {
    prepare(problem, gamma);
    sound = factor(options_.penalty);
  }
  while (sound && !best_.done() && summary.iterations < context.max_iterations) {
    const Residuals residuals = iterate();
    const int k = ++summary.iterations;
    const bool look = k % options_.check_interval == 0 || k == context.max_iterations || k <= 2;
    double now = -1.0;
    if (look) now = best_.offer(z_);
    if (context.on_iteration) context.on_iteration({k, now});
    if (k % options_.balance_interval == 0) sound = balance(residuals);
  }
  if (!sound) summary.status = SolveStatus::numerical_failure;
  best_.conclude(summary);
  return summary;
}

void Admm::release_workspace() {
  system_ = {};
  best_ = {};
  release(weight_, x_, z_, y_, rhs_, product_, c_);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::CcpSolver, scree::Admm>(
      "admm", "Alternating directions: one sparse factorisation, then two triangular solves an iteration.",
      scree::Admm::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("admm", "1.0.0", &list)};
