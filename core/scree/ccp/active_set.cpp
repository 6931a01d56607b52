#include "scree/ccp/active_set.hpp"

#include <algorithm>
#include <cmath>

namespace scree {
namespace {

/// Above this share of active contacts a problem is solved as it is: putting the rest aside costs more than it saves.
constexpr double kWorthwhile = 0.7;
/// Share of the work left that a round may take, so that contacts found missing are solved for as well, and its least length.
constexpr double kRoundShare = 0.3;
constexpr double kShortestRound = 10.0;

/// How far the velocity u [m/s] of a contact without impulse is from the dual cone: below zero it opens by itself. The dual
/// cone of the relaxed problem asks for u_n >= mu |u_t|, not just for a gap that does not close.
double shortage(const CcpContact& contact, const Vec3& u) { return contact.friction * std::hypot(u.y, u.z) - u.x; }

}  // namespace

std::size_t ActiveSetSolve::mark_guess(const CcpProblem& problem, const SolveContext& context,
                                       std::span<const double> gamma) {
  delassus_.bind(problem, context.executor);
  w_.resize(problem.bodies());
  u_.resize(problem.rows());
  delassus_.body_velocities(gamma, w_);
  delassus_.contact_velocities(w_, gamma, u_);
  active_.resize(problem.blocks());
  std::size_t count = 0;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const Vec3 u = load_block(u_, i) + load_block(problem.r, i);
    active_[i] = static_cast<char>(gamma[3 * i] > 0.0 || shortage(problem.contacts[i], u) >= 0.0);
    count += static_cast<std::size_t>(active_[i]);
  }
  return count;
}

std::size_t ActiveSetSolve::add_violated(std::span<const double> gamma, double tolerance) {
  delassus_.body_velocities(gamma, w_);
  delassus_.contact_velocities(w_, gamma, u_);
  std::size_t added = 0;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const CcpProblem& problem = delassus_.problem();
    const Vec3 u = load_block(u_, i) + load_block(problem.r, i);
    if (active_[i] != 0 || shortage(problem.contacts[i], u) <= tolerance) continue;
    active_[i] = 1;
    ++added;
  }
  return added;
}

SolveSummary ActiveSetSolve::solve_active(CcpSolver& solver, const CcpProblem& problem, const SolveContext& context,
                                          std::span<double> gamma) {
  index_.clear();
  contacts_.clear();
  r_.clear();
  compliance_.clear();
  gamma_.clear();
  for (std::uint32_t i = 0; i < active_.size(); ++i) {
    if (active_[i] == 0) continue;
    index_.push_back(i);
    contacts_.push_back(problem.contacts[i]);
    for (std::size_t row = 3 * i; row < 3 * i + 3; ++row) {
      r_.push_back(problem.r[row]);
      gamma_.push_back(gamma[row]);
      if (!problem.compliance.empty()) compliance_.push_back(problem.compliance[row]);
    }
  }
  const CcpProblem part{problem.inverse_mass, problem.inverse_inertia, contacts_, r_, compliance_};
  const SolveSummary summary = solver.solve(part, context, gamma_);
  for (std::size_t k = 0; k < index_.size(); ++k) store_block(gamma, index_[k], load_block(gamma_, k));
  return summary;
}

SolveSummary ActiveSetSolve::solve(CcpSolver& solver, const CcpProblem& problem, const SolveContext& context,
                                   std::span<double> gamma) {
  std::size_t active = mark_guess(problem, context, gamma);
  if (static_cast<double>(active) > kWorthwhile * static_cast<double>(problem.blocks())) {
    return solver.solve(problem, context, gamma);
  }
  SolveSummary total;
  SolveContext round = context;
  double work = 0.0;  // in passes over all contacts: a pass over a part counts as that part
  std::size_t missing = 0;
  do {
    const double left = static_cast<double>(context.max_iterations) - work;
    const auto part = static_cast<double>(active + missing);
    active += missing;
    const double passes = left * static_cast<double>(problem.blocks()) / std::max(1.0, part);
    round.max_iterations = static_cast<int>(std::min(passes, std::max(kShortestRound, kRoundShare * passes)));
    if (round.max_iterations < 1) break;
    const SolveSummary done = solve_active(solver, problem, round, gamma);
    work += done.iterations * part / static_cast<double>(problem.blocks());
    total.status = done.status;
    if (done.status == SolveStatus::numerical_failure || done.status == SolveStatus::infeasible) break;
    missing = add_violated(gamma, context.tolerance);
  } while (missing > 0 || total.status == SolveStatus::iteration_limit);
  total.iterations = static_cast<int>(std::ceil(work));
  total.residual = judge_.residual(problem, gamma, context.executor);
  if (total.residual <= context.tolerance) total.status = SolveStatus::converged;
  if (total.residual > context.tolerance && total.status == SolveStatus::converged) {
    total.status = SolveStatus::iteration_limit;
  }
  return total;
}

}  // namespace scree
