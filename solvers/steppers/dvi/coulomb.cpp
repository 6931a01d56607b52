#include "coulomb.hpp"

#include <algorithm>
#include <limits>

namespace scree::dvi {

namespace {

// How far the step of a contact is changed from the plain fixed point's 1: all of Newton's, part of it, none, less.
double step_length(int level, double boost) {
  switch (level) {
    case 0:
      return 1.0 + boost;
    case 1:
      return 1.0 + 0.25 * boost;
    case 2:
      return 1.0;
    default:
      return std::ldexp(1.0, 2 - level);
  }
}
constexpr int kLastLevel = 8;

}  // namespace

// error_ for the current u_ and s_; returns the greatest.
double CoulombFixedPoint::update_errors(const CcpProblem& problem) {
  double worst = 0.0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    error_[i] = problem.contacts[i].friction * std::hypot(u_[3 * i + 1], u_[3 * i + 2]) - s_[i];
    worst = std::max(worst, std::abs(error_[i]));
  }
  return worst;
}

CoulombSummary CoulombFixedPoint::solve(StepServices& services, const CcpProblem& problem, DelassusOperator& delassus,
                                        const CoulombLimits& limits, std::span<double> gamma) {
  const std::size_t m = problem.contacts.size();
  r_.assign(problem.r.begin(), problem.r.end());
  u_.resize(3 * m);
  s_.resize(m);
  error_.resize(m);
  boost_.resize(m);
  for (std::size_t i = 0; i < m; ++i) {
    const Mat3 block = diagonal_block(problem, i);
    const double mu = problem.contacts[i].friction;
    boost_[i] = block.row0.x > 0.0 ? mu * mu * 0.5 * (block.row1.y + block.row2.z) / block.row0.x : 0.0;
  }
  // The first s: that of the guess.
  delassus.apply(gamma, u_);
  for (std::size_t k = 0; k < 3 * m; ++k) u_[k] += problem.r[k];
  std::fill(s_.begin(), s_.end(), 0.0);
  update_errors(problem);
  s_ = error_;

  CoulombSummary summary;
  double least = std::numeric_limits<double>::infinity();
  int level = 0;
  while (true) {
    for (std::size_t i = 0; i < m; ++i) r_[3 * i] = problem.r[3 * i] + s_[i];
    CcpProblem associated = problem;
    associated.r = r_;
    const SolveSummary solved = services.solve_ccp(associated, gamma);
    const int iterations = summary.solve.iterations + solved.iterations;
    ++summary.solves;
    delassus.apply(gamma, u_);
    for (std::size_t k = 0; k < 3 * m; ++k) u_[k] += problem.r[k];
    const double error = update_errors(problem);
    // Too little gained: back to the best s, with a shorter step.
    const bool worse = !(error < 0.9 * least);
    if (error < least) {
      least = error;
      best_s_ = s_;
      best_error_ = error_;
      best_gamma_.assign(gamma.begin(), gamma.end());
      summary.solve = solved;
    }
    summary.solve.iterations = iterations;
    if (worse && summary.solves > 1) ++level;
    if (least <= limits.tolerance || summary.solves >= limits.max_solves || level > kLastLevel) break;
    for (std::size_t i = 0; i < m; ++i) {
      s_[i] = std::max(0.0, best_s_[i] + step_length(level, boost_[i]) * best_error_[i]);
    }
  }
  if (std::isfinite(least)) std::copy(best_gamma_.begin(), best_gamma_.end(), gamma.begin());
  summary.error = least;
  if (least > limits.tolerance && summary.solve.status == SolveStatus::converged) {
    summary.solve.status = SolveStatus::iteration_limit;
  }
  return summary;
}

}  // namespace scree::dvi
