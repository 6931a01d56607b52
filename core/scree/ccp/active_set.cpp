#include "scree/ccp/active_set.hpp"

#include <algorithm>
#include <cmath>

#include "scree/base/release.hpp"
#include "scree/base/require.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/ccp/judge.hpp"

namespace scree {
namespace {

/// Above this share of active contacts a problem is solved as it is: putting the rest aside costs more than it saves. In a large
/// problem it must not cost memory either: beside a solver's 200 bytes a contact, the part takes 160 of each active one.
constexpr double kWorthwhile = 0.7;
constexpr double kWorthItsMemory = 0.5;
/// Share of the iterations left that a round may take, so that contacts found missing are solved for as well; the share after
/// a round that found none; and the least length of a round, since to begin one costs some iterations.
constexpr double kRoundShare = 0.3;
constexpr double kSettledShare = 0.8;
constexpr int kShortestRound = 10;

/// What the judge would say of a contact without impulse [m/s], which moves with u: its distance from the dual cone. Below zero
/// it opens by itself. The dual cone of the relaxed problem asks for u_n >= mu |u_t|, not just for a gap that does not close.
double shortage(const CcpContact& contact, const Vec3& u) {
  const double mu = contact.friction;
  return (mu * std::sqrt(u.y * u.y + u.z * u.z) - u.x) / std::sqrt(1.0 + mu * mu);
}

/// Length of a round when `left` iterations are left.
int round_length(int left, bool settled) {
  const int share = std::max(kShortestRound, static_cast<int>((settled ? kSettledShare : kRoundShare) * left));
  // What would be left for the last round is not worth a beginning of its own.
  return left - share < kShortestRound ? left : share;
}

bool is_worthwhile(std::size_t active, std::size_t contacts) {
  const double most = contacts >= kManyRecords ? kWorthItsMemory : kWorthwhile;
  return static_cast<double>(active) <= most * static_cast<double>(contacts);
}

/// `context` for the rest of a solve that has made `done` iterations; `done` outlives it.
SolveContext continued(const SolveContext& context, const int& done) {
  SolveContext rest = context;
  rest.max_iterations -= done;
  if (context.on_iteration) {
    rest.on_iteration = [&](const IterationReport& report) {
      context.on_iteration({done + report.iteration, report.residual});
    };
  }
  return rest;
}

}  // namespace

std::size_t ActiveSetSolve::add_violated(std::span<const double> gamma, double tolerance) {
  const CcpProblem& problem = delassus_.problem();
  w_.resize(problem.bodies());
  delassus_.body_velocities(gamma, w_);
  std::size_t added = 0;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (active_[i] != 0) continue;
    const CcpContact& c = problem.contacts[i];
    const Vec3 u = relative_velocity(c, w_[c.a], w_[c.b]) + load_block(problem.r, i);
    // A number that is not finite is for the solver to report.
    if (shortage(c, u) <= tolerance) continue;
    active_[i] = 1;
    ++added;
  }
  return added;
}

std::size_t ActiveSetSolve::mark_guess(const CcpProblem& problem, const SolveContext& context,
                                       std::span<const double> gamma) {
  delassus_.bind(problem, context.executor);
  active_.resize(problem.contacts.size());
  std::size_t carrying = 0;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    active_[i] = static_cast<char>(gamma[3 * i] > 0.0);
    carrying += static_cast<std::size_t>(active_[i]);
  }
  return carrying + add_violated(gamma, 0.0);
}

SolveSummary ActiveSetSolve::solve_active(CcpSolver& solver, const SolveContext& context, std::size_t active,
                                          std::span<double> gamma) {
  const CcpProblem& problem = delassus_.problem();
  const bool compliant = !problem.compliance.empty();
  index_.clear();
  contacts_.clear();
  r_.clear();
  compliance_.clear();
  gamma_.clear();
  // Room for all in a small problem, as how many are active changes from step to step; a large one is short of room.
  const bool large = problem.contacts.size() >= kManyRecords;
  const std::size_t room = large ? active : problem.contacts.size();
  make_room(room, index_, contacts_);
  const std::size_t rows = 3 * room + problem.rows() - problem.contact_rows();
  make_room(rows, r_, gamma_);
  if (compliant) make_room(rows, compliance_);
  for (std::uint32_t i = 0; i < active_.size(); ++i) {
    if (active_[i] == 0) continue;
    index_.push_back(i);
    contacts_.push_back(problem.contacts[i]);
    for (std::size_t row = 3 * std::size_t{i}; row < 3 * std::size_t{i} + 3; ++row) {
      r_.push_back(problem.r[row]);
      gamma_.push_back(gamma[row]);
      if (compliant) compliance_.push_back(problem.compliance[row]);
    }
  }
  // All blocks, as they are.
  const auto append = [&](std::vector<double>& part, std::span<const double> whole) {
    part.insert(part.end(), whole.begin() + static_cast<std::ptrdiff_t>(problem.contact_rows()), whole.end());
  };
  append(r_, problem.r);
  append(gamma_, gamma);
  if (compliant) append(compliance_, problem.compliance);
  CcpProblem part = problem;
  part.contacts = contacts_;
  part.r = r_;
  part.compliance = compliance_;
  if (large) {
    delassus_.release_sums();
    release(w_);
    solver.release_workspace();  // of the round before, which was smaller
  }
  const SolveSummary summary = solver.solve(part, context, gamma_);
  for (std::size_t k = 0; k < index_.size(); ++k) store_block(gamma, index_[k], load_block(gamma_, k));
  std::copy(gamma_.begin() + static_cast<std::ptrdiff_t>(part.contact_rows()), gamma_.end(),
            gamma.begin() + static_cast<std::ptrdiff_t>(problem.contact_rows()));
  return summary;
}

SolveSummary ActiveSetSolve::solve_rounds(CcpSolver& solver, const SolveContext& context, std::size_t& active,
                                          std::span<double> gamma) {
  SolveSummary total;
  SolveContext round = continued(context, total.iterations);
  bool settled = false;
  const bool blocks = !delassus_.problem().blocks.empty();
  while (active > 0 ? is_worthwhile(active, active_.size()) : blocks) {
    round.max_iterations = round_length(context.max_iterations - total.iterations, settled);
    total.status = SolveStatus::iteration_limit;
    if (round.max_iterations < 1) break;
    const SolveSummary done = solve_active(solver, round, active, gamma);
    total.iterations += done.iterations;
    total.status = done.status;
    if (done.status == SolveStatus::numerical_failure || done.status == SolveStatus::infeasible) break;
    const std::size_t missing = add_violated(gamma, context.tolerance);
    active += missing;
    settled = missing == 0;
    // A solver that can do no more ends the solve as well.
    if (settled && (done.status != SolveStatus::iteration_limit || done.iterations < round.max_iterations)) break;
  }
  return total;
}

SolveSummary ActiveSetSolve::solve(CcpSolver& solver, const CcpProblem& problem, const SolveContext& context,
                                   std::span<double> gamma) {
  SCREE_REQUIRE(gamma.size() == problem.rows(), "ActiveSetSolve: gamma needs a number a row");
  if (problem.empty()) return {};
  if (problem.contacts.empty()) return solver.solve(problem, context, gamma);
  project_guess(problem, gamma);
  std::size_t active = mark_guess(problem, context, gamma);
  SolveSummary total = solve_rounds(solver, context, active, gamma);
  const bool can_go_on = total.iterations == 0 || total.iterations < context.max_iterations;
  if (can_go_on && !is_worthwhile(active, problem.contacts.size())) {
    // The workspace is free for the solver's.
    if (problem.contacts.size() >= kManyRecords) {
      *this = {};
      solver.release_workspace();
    }
    SolveSummary whole = solver.solve(problem, continued(context, total.iterations), gamma);
    whole.iterations += total.iterations;
    return whole;
  }
  w_.resize(problem.bodies());
  delassus_.body_velocities(gamma, w_);
  total.residual = ccp_residual(delassus_, gamma, w_, partial_);
  if (!std::isfinite(total.residual)) total.status = SolveStatus::numerical_failure;
  // The part may have met the tolerance, and the whole not, by rounding only.
  if (total.residual <= context.tolerance) total.status = SolveStatus::converged;
  if (total.residual > context.tolerance && total.status == SolveStatus::converged) {
    total.status = SolveStatus::iteration_limit;
  }
  return total;
}

}  // namespace scree
