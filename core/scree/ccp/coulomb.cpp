#include "scree/ccp/coulomb.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/ccp/matrix.hpp"

namespace scree {

namespace {

/// A CCP is solved this much further than the error of the s that it is for; after a step without gain, twice as far.
constexpr double kAhead = 0.02, kFurthest = 1e-3;
/// Of the tolerance, where the iteration ends of itself: it gets there in a step or two, and the last s then leaves the norms
/// of many contacts together as small as that of the worst one.
constexpr double kAim = 0.1;
/// Of that, what the last CCPs may use up.
constexpr double kShare = 0.5;
/// One CCP does not use up all iterations: there is enough for this many, if they have this many iterations at least.
constexpr int kFewestSolves = 20, kShortestSolve = 100;
/// Steps without gain after which the iteration begins again from the best point, and how short they may become.
constexpr int kPatience = 4;
constexpr double kShortest = 1.0 / 64.0;
/// A gain of less than this is none.
constexpr double kGain = 0.9;
/// Asymmetry [1] that comes from rounding.
constexpr double kRounding = 1e-13;

/// The row of r to which exact friction adds, of contact or block `i`.
std::size_t normal_row(const CcpProblem& problem, std::size_t i) {
  const std::size_t contacts = problem.contacts.size();
  return i < contacts ? 3 * i : problem.contact_rows() + problem.blocks[i - contacts].first_row;
}

/// mu ||u_t|| + ... of unit `i` for the velocities u + r.
double slip_rate(const CcpProblem& problem, std::span<const double> u, std::size_t i) {
  const std::size_t contacts = problem.contacts.size();
  const std::size_t row = normal_row(problem, i);
  if (i < contacts) {
    return problem.contacts[i].friction * std::hypot(u[row + 1] + problem.r[row + 1], u[row + 2] + problem.r[row + 2]);
  }
  const CcpBlock& block = problem.blocks[i - contacts];
  std::array<double, CcpBlock::kMostRows> velocity{};
  for (std::size_t k = 0; k < block.rows; ++k) velocity[k] = u[row + k] + problem.r[row + k];
  return dissipation_rate(block, std::span{velocity}.first(block.rows));
}

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

std::vector<double> exact_r(const CcpProblem& problem, std::span<const double> gamma, const Executor* executor) {
  DelassusOperator delassus;
  delassus.bind(problem, executor);
  std::vector<double> u(problem.rows());
  delassus.apply(gamma, u);
  std::vector<double> r{problem.r.begin(), problem.r.end()};
  for (std::size_t i = 0; i < problem.units(); ++i) r[normal_row(problem, i)] += slip_rate(problem, u, i);
  return r;
}

void CoulombIteration::bind(const CcpProblem& problem, const Executor& executor) {
  const std::size_t rows = problem.rows(), units = problem.units();
  given_ = exact_ = posed_ = problem;
  exact_r_.assign(problem.r.begin(), problem.r.end());
  posed_r_ = exact_r_;
  exact_.r = exact_r_;
  posed_.r = posed_r_;
  u_.resize(rows);
  w_.resize(problem.bodies());
  now_.s.assign(units, 0.0);
  now_.f.assign(units, 0.0);
  best_.error = std::numeric_limits<double>::infinity();
  delassus_.bind(exact_, &executor);
  values_.clear();
  if (!problem.matrix.empty() && asymmetry(problem.matrix, problem.blocks) > kRounding) {
    values_ = symmetric_values(problem.matrix, problem.blocks);
    posed_.matrix.values = values_;
    symmetric_.bind(posed_, &executor);
    symmetric_u_.resize(rows);
  }
}

// u of `gamma`, the s that follows from it, and with that the error of the exact conditions.
void CoulombIteration::look(std::span<const double> gamma, const CoulombLimits& limits) {
  delassus_.body_velocities(gamma, w_);
  delassus_.row_velocities(w_, gamma, u_);
  for (std::size_t i = 0; i < now_.s.size() && limits.coulomb; ++i) {
    const std::size_t row = normal_row(given_, i);
    const double rate = slip_rate(given_, u_, i);
    now_.f[i] = rate - now_.s[i];
    exact_r_[row] = given_.r[row] + rate;
  }
  const bool by_change = limits.coulomb && limits.solver_has_its_own_goal;
  now_.error = by_change ? largest(now_.f) : ccp_residual(delassus_, gamma, w_, partial_);
}

// r of the CCP that the solver gets: with s and, where N is not symmetric, with A gamma.
void CoulombIteration::pose(std::span<const double> gamma) {
  std::copy(given_.r.begin(), given_.r.end(), posed_r_.begin());
  for (std::size_t i = 0; i < now_.s.size(); ++i) posed_r_[normal_row(given_, i)] += now_.s[i];
  if (values_.empty()) return;
  delassus_.apply(gamma, u_);
  symmetric_.apply(gamma, symmetric_u_);
  for (std::size_t k = 0; k < posed_r_.size(); ++k) posed_r_[k] += u_[k] - symmetric_u_[k];
}

// Moves s; false when there is nowhere left to go.
bool CoulombIteration::advance(std::span<double> gamma) {
  if (now_.error < kGain * best_.error) {
    without_gain_ = 0;
  } else {
    ++without_gain_;
    ahead_ = std::max(0.5 * ahead_, kFurthest);
  }
  if (now_.error < best_.error) {
    best_ = now_;
    best_gamma_.assign(gamma.begin(), gamma.end());
  }
  if (without_gain_ > kPatience) {
    without_gain_ = 0;
    damping_ *= 0.5;
    if (damping_ < kShortest) return false;
    mixing_.restart(now_.s.size());
    now_ = best_;
    std::copy(best_gamma_.begin(), best_gamma_.end(), gamma.begin());
  }
  mixing_.advance(now_.s, now_.f, damping_);
  for (double& s : now_.s) s = std::max(0.0, s);
  return true;
}

void CoulombIteration::iterate(const InnerSolve& inner, const CoulombLimits& limits, std::span<double> gamma,
                               CoulombSummary& summary) {
  const double aim = (limits.coulomb && !limits.solver_has_its_own_goal ? kAim : 1.0) * limits.tolerance;
  const int longest =
      limits.coulomb ? std::max(kShortestSolve, limits.max_iterations / kFewestSolves) : limits.max_iterations;
  int iterations = 0;
  SolveStatus status = SolveStatus::iteration_limit;
  while (summary.solves < limits.max_solves && iterations < limits.max_iterations) {
    pose(gamma);
    const double ahead = ahead_ * std::min(now_.error, best_.error);
    const InnerGoal goal{std::max(kShare * aim, std::isfinite(ahead) ? ahead : 0.0),
                         std::min(limits.max_iterations - iterations, longest)};
    now_.solve = inner(posed_, goal, gamma);
    iterations += now_.solve.iterations;
    ++summary.solves;
    look(gamma, limits);
    const bool lost = now_.solve.status == SolveStatus::numerical_failure;
    const bool on = advance(gamma);
    if (lost || !on) status = lost ? SolveStatus::numerical_failure : SolveStatus::stalled;
    if (lost || !on || best_.error <= aim) break;
  }
  summary.solve = best_.solve;
  summary.solve.status = best_.error <= limits.tolerance ? SolveStatus::converged : status;
  summary.solve.iterations = iterations;
  summary.error = best_.error;
}

CoulombSummary CoulombIteration::solve(const CcpProblem& problem, const Executor& executor, const InnerSolve& inner,
                                       const CoulombLimits& limits, std::span<double> gamma) {
  bind(problem, executor);
  CoulombSummary summary;
  if (!limits.coulomb && values_.empty()) {
    summary.solve = inner(problem, {limits.tolerance, limits.max_iterations}, gamma);
    summary.solves = 1;
    look(gamma, limits);
    summary.error = now_.error;
    return summary;
  }
  damping_ = 1.0;
  ahead_ = kAhead;
  without_gain_ = 0;
  mixing_.restart(problem.units());
  look(gamma, limits);  // the first s: that of the guess
  std::swap(now_.s, now_.f);
  iterate(inner, limits, gamma, summary);
  if (std::isfinite(best_.error)) std::copy(best_gamma_.begin(), best_gamma_.end(), gamma.begin());
  return summary;
}

}  // namespace scree
