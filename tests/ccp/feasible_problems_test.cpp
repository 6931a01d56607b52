// Every CCP solver on random feasible problems: contacts and rows of every kind, with bodies or with N written out, singular
// N, no friction and a coefficient of a million, mass ratios up to a million. The velocities of all solutions are known; a
// solver that reports convergence has them, and one that does not converge says so.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <iostream>
#include <map>

#include "conformance/ccp_solver_case.hpp"
#include "scree/ccp/guess.hpp"
#include "scree/config/validate.hpp"
#include "scree/host/plugin_host.hpp"
#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_planted_problems.hpp"
#include "support/trials.hpp"

namespace scree::test {
namespace {

/// Of the largest speed: five decades below what is compared, as a residual may become a velocity error of a hundred thousand
/// times its size in these problems (and of its square root where impulse and velocity vanish together).
constexpr double kTolerance = 1e-10;
/// Velocities of two solvers may differ by this much of the largest speed, half of it for each.
constexpr double kAgreement = 1e-6;

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
  what.repeats = 0.3 * below(0, 2);
  what.seed = *rc::gen::arbitrary<std::uint64_t>();
  Trial trial{planted_problem(what), {}, 0.0, {}};
  trial.problem = below(0, 3) == 0 ? with_matrix(trial.planted.problem) : trial.planted.problem;
  const std::vector<double>& u = trial.planted.u;
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

/// On the limit of friction u_n = mu |u_t|: a residual that leaves |u_t| uncertain leaves u_n mu times as uncertain.
double largest_coefficient(const CcpProblem& problem) {
  double largest = 0.0;
  for (const CcpContact& contact : problem.contacts) largest = std::max(largest, contact.friction);
  for (const CcpBlock& block : problem.blocks) {
    if (block.kind == CcpKind::cone) largest = std::max({largest, block.friction, block.spinning, block.rolling});
  }
  return largest;
}

/// Asserts what every solver owes; returns how it ended.
SolveSummary solve_trial(const PluginEntry& entry, const Trial& trial, int max_iterations) {
  const CcpProblem problem = trial.problem.view();
  const std::unique_ptr<CcpSolver> solver = make(entry);
  std::vector<double> gamma = trial.guess, start = trial.guess;
  SolveContext context;
  context.tolerance = kTolerance * trial.speed;
  context.max_iterations = max_iterations;
  const SolveSummary summary = solver->solve(problem, context, gamma);

  RC_LOG() << entry.name << ": " << to_string(summary.status) << " after " << summary.iterations << ", residual "
           << summary.residual << ", speed " << trial.speed << '\n';
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
  RC_ASSERT(error <= std::max(0.5 * kAgreement, 10.0 * largest_coefficient(problem) * kTolerance) * trial.speed);
  return summary;
}

// A thousand problems. The long tests give each solver the iterations that it needs, and print where they did not suffice.
TEST(feasible_problems, solvers_that_report_convergence_agree_and_the_others_say_so) {
  const int problems = trials(1000);
  const bool to_the_end = std::getenv("SCREE_TRIALS") != nullptr;
  ASSERT_EQ(::setenv("RC_PARAMS", ("seed=3 max_success=" + std::to_string(problems)).c_str(), 0), 0);
  std::map<std::string, int> converged;
  int count = 0;
  EXPECT_TRUE(rc::check("feasible problems", [&] {
    const Trial trial = draw_trial();
    ++count;
    for (const PluginEntry* entry : solvers()) {
      const SolveSummary summary = solve_trial(*entry, trial, to_the_end ? 200000 : 1000);
      converged[entry->name] += static_cast<int>(summary.status == SolveStatus::converged);
      if (!to_the_end || summary.status == SolveStatus::converged) continue;
      std::cout << "problem " << count << ", " << entry->name << ": " << to_string(summary.status) << " after "
                << summary.iterations << ", residual " << summary.residual / trial.speed << " of the largest speed\n";
    }
  }));
  for (const auto& [name, times] : converged) std::cout << name << ": " << times << " of " << count << " converged\n";
}

}  // namespace
}  // namespace scree::test
