#include "scree/ccp/direct/best_answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"

namespace scree::direct {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Rounding of a sum of the objective's terms, in their size.
constexpr double kRounding = 1e-15;

}  // namespace

bool BestAnswer::start(const CcpProblem& problem, const SolveContext& context, std::span<double> gamma) {
  gamma_ = gamma;
  tolerance_ = context.tolerance;
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
  if (!(residual < residual_)) return residual;
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

void BestAnswer::velocities_of_guess(std::span<double> u) const {
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = guess_velocities_[k] + delassus_.problem().r[k];
}

void BestAnswer::conclude(SolveSummary& summary) const {
  summary.residual = std::isinf(residual_) ? guess_residual_ : residual_;
  if (!std::isfinite(summary.residual)) summary.status = SolveStatus::numerical_failure;
  if (summary.residual <= tolerance_) summary.status = SolveStatus::converged;
}

}  // namespace scree::direct
