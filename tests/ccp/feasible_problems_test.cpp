// Every CCP solver on random feasible problems: contacts and rows of every kind, with bodies or with N written out, singular
// N, no friction and coefficients of up to a million, mass ratios up to a million. The velocities of all solutions are known; a
// solver that reports convergence has them, and one that does not converge says so.
//
// Nothing is left out: neither ill-conditioned N (eigenvalues that differ by 1e11), nor contacts that slide with a coefficient of a
// million, whose u_n = mu |u_t| has mu times the error of u_t.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>

#include "conformance/ccp_solver_case.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/config/validate.hpp"
#include "scree/host/plugin_host.hpp"
#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_planted_problems.hpp"
#include "support/trials.hpp"

namespace scree::test {
namespace {

/// Velocities may differ from those of all solutions by this much of the largest speed.
constexpr double kAgreement = 1e-6;

/// The greatest coefficient with which something slides, spins or rolls at the velocities `u`, whose other rows stick at exactly zero.
double greatest_sliding_friction(const CcpProblem& problem, std::span<const double> u) {
  double greatest = 1.0;
  const auto note = [&](double coefficient, std::size_t first, std::size_t rows) {
    for (std::size_t k = first; k < first + rows; ++k) {
      if (u[k] != 0.0) greatest = std::max(greatest, coefficient);
    }
  };
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) note(problem.contacts[i].friction, 3 * i + 1, 2);
  for (const CcpBlock& block : problem.blocks) {
    if (block.kind != CcpKind::cone) continue;
    const std::size_t first = first_row(problem, block);
    if (block.rows >= 2) note(block.friction, first + 1, block.rows == 2 ? 1 : 2);
    if (block.rows == 6) note(block.spinning, first + 3, 1);
    if (block.rows >= 5) note(block.rolling, first + block.rows - 2, 2);
  }
  return greatest;
}

/// A residual, of the largest speed, that means velocities to kAgreement. The greatest error of an answer was 1e4 times its residual
/// (with eigenvalues that differ by 1e3; not more where they differ by 1e11), and where something slides with a coefficient above 1e4
/// about the coefficient times the residual: velocities within that of the dual cone look as good. No less than what rounding leaves.
double tolerance_for(double sliding_friction) { return std::clamp(kAgreement / sliding_friction, 2e-12, 1e-10); }

std::unique_ptr<CcpSolver> make(const PluginEntry& entry) {
  return std::unique_ptr<CcpSolver>{dynamic_cast<CcpSolver*>(entry.make(default_options(entry.parameters)).release())};
}

/// Those that take problems of every kind.
const std::vector<const PluginEntry*>& solvers() {
  static const std::vector<const PluginEntry*> found = [] {
    auto* host = new PluginHost;  // plugins are never unloaded
    host->search(SCREE_PLUGINS);
    std::vector<const PluginEntry*> list;
    for (const PluginEntry* entry : host->entries()) {
      if (entry->kind == CcpSolver::kKind && takes_blocks(*make(*entry))) list.push_back(entry);
    }
    return list;
  }();
  return found;
}

struct Trial {
  PlantedProblem planted;
  TestingProblem problem;     ///< the planted one, or its form without bodies
  double speed = 0.0;         ///< the largest: of u, and of what the impulses add to it [m/s]
  double friction = 1.0;      ///< the greatest with which something slides [1]
  std::vector<double> guess;  ///< may lie outside of what impulses may be
};

Trial draw_trial() {
  const auto below = [](int low, int high) { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high)); };
  PlantedKind what;
  what.bodies = static_cast<std::size_t>(below(1, 9));
  what.immovable = static_cast<std::size_t>(below(1, 3));
  what.contacts = static_cast<std::size_t>(below(0, 9));
  what.blocks = static_cast<std::size_t>(below(0, 7));
  what.compliant = below(0, 3) == 0;
  what.mass_decades = below(0, 7);
  what.friction_decades = below(0, 7);
  what.slides = std::numeric_limits<double>::infinity();
  what.repeats = 0.3 * below(0, 2);
  what.seed = *rc::gen::arbitrary<std::uint64_t>();
  Trial trial{planted_problem(what), {}, 0.0, 1.0, {}};
  trial.problem = below(0, 3) == 0 ? with_matrix(trial.planted.problem) : trial.planted.problem;
  const std::vector<double>& u = trial.planted.u;
  trial.friction = greatest_sliding_friction(trial.problem.view(), u);
  for (std::size_t k = 0; k < u.size(); ++k) {
    trial.speed = std::max({trial.speed, std::abs(u[k]), std::abs(u[k] - trial.problem.r[k])});
  }
  trial.guess.resize(u.size());
  if (below(0, 2) == 0) {
    std::mt19937_64 random{what.seed};
    std::normal_distribution<double> normal;
    for (std::size_t k = 0; k < u.size(); ++k) trial.guess[k] = trial.planted.gamma[k] + 0.1 * normal(random);
  }
  return trial;
}

/// Asserts what every solver owes; returns how it ended.
SolveSummary solve_trial(const PluginEntry& entry, const Trial& trial, int max_iterations) {
  const CcpProblem problem = trial.problem.view();
  const std::unique_ptr<CcpSolver> solver = make(entry);
  std::vector<double> gamma = trial.guess, start = trial.guess;
  SolveContext context;
  context.tolerance = tolerance_for(trial.friction) * trial.speed;
  context.max_iterations = max_iterations;
  const SolveSummary summary = solver->solve(problem, context, gamma);

  RC_LOG() << entry.name << ": " << to_string(summary.status) << " after " << summary.iterations << ", residual "
           << summary.residual << ", speed " << trial.speed << '\n';
  RC_ASSERT(summary.status != SolveStatus::infeasible);
  RC_ASSERT(std::all_of(gamma.begin(), gamma.end(), [](double g) { return std::isfinite(g); }));
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  project_guess(problem, start);
  const double before = delassus.objective(start), after = delassus.objective(gamma);
  // Rounding of the sums: their terms are no larger than those of r . gamma.
  double terms = 0.0;
  for (std::size_t k = 0; k < gamma.size(); ++k) terms += std::abs(problem.r[k] * start[k]);
  RC_ASSERT(after <= before + 1e-12 * terms);
  if (summary.status != SolveStatus::converged) return summary;

  const CcpFigures figures = CcpJudge{}.figures(problem, gamma, nullptr);
  RC_ASSERT(figures.residual <= 1.01 * context.tolerance);
  std::vector<double> u(gamma.size());
  delassus.apply(gamma, u);
  double error = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    error = std::max(error, std::abs(u[k] + problem.r[k] - trial.planted.u[k]));
  }
  RC_LOG() << "error of the velocity: " << error / trial.speed << " of the largest\n";
  RC_ASSERT(error <= kAgreement * trial.speed);
  return summary;
}

std::string line(int problem, const std::string& name, const SolveSummary& summary, const Trial& trial) {
  std::ostringstream out;
  out << "problem " << problem << ", sliding friction " << trial.friction << ", " << name << ": "
      << to_string(summary.status) << " after " << summary.iterations << ", residual " << summary.residual / trial.speed
      << " of the largest speed, asked " << tolerance_for(trial.friction);
  return out.str();
}

// The long tests give each solver the iterations that it needs: then at
// least three converge on all, and what the others missed is printed.
TEST(feasible_problems, solvers_that_report_convergence_agree_and_the_others_say_so) {
  const bool to_the_end = std::getenv("SCREE_TRIALS") != nullptr;
  ASSERT_EQ(::setenv("RC_PARAMS", ("seed=3 max_success=" + std::to_string(trials(1100))).c_str(), 0), 0);
  std::map<std::string, int> converged;
  int count = 0;
  EXPECT_TRUE(rc::check("feasible problems", [&] {
    const Trial trial = draw_trial();
    ++count;
    for (const PluginEntry* entry : solvers()) {
      const SolveSummary summary = solve_trial(*entry, trial, to_the_end ? 200000 : 1000);
      converged[entry->name] += static_cast<int>(summary.status == SolveStatus::converged);
      if (to_the_end && summary.status != SolveStatus::converged) {
        std::cout << line(count, entry->name, summary, trial) << '\n';
      }
    }
  }));
  EXPECT_GE(count, 1000);
  int complete = 0;
  for (const auto& [name, times] : converged) {
    complete += static_cast<int>(times == count);
    std::cout << name << ": " << times << " of " << count << " converged\n";
  }
  EXPECT_GE(complete, to_the_end ? 3 : 0);
}

}  // namespace
}  // namespace scree::test
