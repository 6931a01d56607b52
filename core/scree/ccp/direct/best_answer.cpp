#include "scree/ccp/direct/best_answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"

namespace scree::direct {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Rounding of a sum of the objective's terms, in their size.
constexpr double kRounding = 1e-15;
/// Impulses so many times what their units need alone may grow without end.
constexpr double kGrown = 100.0;

}  // namespace

bool BestAnswer::start(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  gamma_ = gamma;
  tolerance_ = context.tolerance;
  infeasible_ = false;
  previous_.clear();
  speed_ = 0.0;
  for (const double x : problem.r) speed_ = std::max(speed_, std::abs(x));
  residual_ = guess_residual_ = kInfinite;
  if (!project_guess(problem, gamma)) return false;
  delassus_.bind(problem, context.executor);
  guess_.assign(gamma.begin(), gamma.end());
  guess_velocities_.resize(problem.rows());
  velocities_.resize(problem.rows());
  w_.resize(problem.bodies());
  delassus_.body_velocities(guess_, w_);
  delassus_.row_velocities(w_, guess_, guess_velocities_);
  guess_residual_ = ccp_residual(delassus_, guess_, w_, partial_);
  // A step downhill beats the guess, whose residual may be small by accident far away: it counts only when it is enough.
  if (guess_residual_ <= tolerance_) residual_ = guess_residual_;
  return true;
}

double BestAnswer::offer(std::span<const double> gamma) {
  delassus_.body_velocities(gamma, w_);
  const double residual = ccp_residual(delassus_, gamma, w_, partial_);
  const bool looked = residual > tolerance_ && !infeasible_ && look_for_a_certificate(gamma);
  if (!(residual < residual_)) return residual;
  if (looked) delassus_.body_velocities(gamma, w_);
  delassus_.row_velocities(w_, gamma, velocities_);
  // The change of the objective itself: the difference of two objectives drowns in their rounding.
  const std::span<const double> r = delassus_.problem().r;
  double change = 0.0, size = 0.0;
  for (std::size_t k = 0; k < gamma.size(); ++k) {
    const double term = (gamma[k] - guess_[k]) * (0.5 * (velocities_[k] + guess_velocities_[k]) + r[k]);
    change += term;
    size += std::abs(term);
  }
  if (change > kRounding * size) return residual;
  residual_ = residual;
  std::ranges::copy(gamma, gamma_.begin());
  return residual;
}

bool BestAnswer::look_for_a_certificate(std::span<const double> gamma) {
  const CcpProblem& problem = delassus_.problem();
  const std::span<const double> traces = delassus_.traces();
  double largest = 0.0;  // impulse, in what its unit needs alone
  const auto for_units = [&](const auto& visit) {
    for (std::size_t i = 0; i < problem.contacts.size(); ++i) visit(i, 3 * i, std::size_t{3});
    for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
      const CcpBlock& block = problem.blocks[i];
      visit(problem.contacts.size() + i, first_row(problem, block), std::size_t{block.rows});
    }
  };
  const auto need_of = [&](std::size_t unit, std::size_t rows) {
    return traces[unit] > 0.0 ? speed_ * static_cast<double>(rows) / traces[unit] : 0.0;
  };
  for_units([&](std::size_t unit, std::size_t first, std::size_t rows) {
    const double need = need_of(unit, rows);
    for (std::size_t k = first; k < first + rows && need > 0.0; ++k) {
      largest = std::max(largest, std::abs(gamma[k]) / need);
    }
  });
  previous_.resize(gamma.size(), 0.0);
  direction_.assign(gamma.begin(), gamma.end());
  for (std::size_t k = 0; k < gamma.size(); ++k) direction_[k] -= std::exchange(previous_[k], gamma[k]);
  if (largest < kGrown || !project_guess(problem, direction_)) return false;
  // What a box allows ends somewhere.
  for (const CcpBlock& block : problem.blocks) {
    if (block.kind != CcpKind::box) continue;
    for (double& x : rows_of(problem, block, std::span{direction_})) {
      x = std::clamp(x, std::isinf(block.lower) ? -kInfinite : 0.0, std::isinf(block.upper) ? kInfinite : 0.0);
    }
  }
  delassus_.body_velocities(direction_, w_);
  delassus_.row_velocities(w_, direction_, velocities_);
  double push = 0.0, resistance = 0.0;
  for_units([&](std::size_t unit, std::size_t first, std::size_t rows) {
    double square = 0.0;
    for (std::size_t k = first; k < first + rows; ++k) {
      push -= problem.r[k] * direction_[k];
      square += velocities_[k] * velocities_[k];
    }
    resistance += std::sqrt(square) * need_of(unit, rows);
  });
  infeasible_ = push > kBeyond * resistance;
  return true;
}

bool BestAnswer::guess_is_above_zero() const {
  const CcpProblem& problem = delassus_.problem();
  double objective = 0.0;
  for (std::size_t k = 0; k < guess_.size(); ++k) objective += guess_[k] * (0.5 * guess_velocities_[k] + problem.r[k]);
  return objective > 0.0 && std::none_of(problem.blocks.begin(), problem.blocks.end(), [](const CcpBlock& block) {
           return block.kind == CcpKind::box && (block.lower > 0.0 || block.upper < 0.0);
         });
}

void BestAnswer::velocities_of_guess(std::span<double> u) const {
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = guess_velocities_[k] + delassus_.problem().r[k];
}

void BestAnswer::conclude(SolveSummary& summary) const {
  summary.residual = std::isinf(residual_) ? guess_residual_ : residual_;
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (infeasible_ && summary.status != SolveStatus::numerical_failure) summary.status = SolveStatus::infeasible;
  if (summary.residual <= tolerance_) summary.status = SolveStatus::converged;
}

}  // namespace scree::direct
