// Every CCP solver on random feasible problems: contacts and rows of every kind, with bodies or with N written out, singular
// N, no friction and coefficients of up to a million, mass ratios up to a million. The velocities of all solutions are known; a
// solver that reports convergence has them, and one that does not converge says so.
//
// Left out, for then no residual above the rounding of impulses says 1e-6 of the velocities: problems with an N of rank k whose
// eigenvalues, in every unit's own mass, differ by more than 1e5 (one of sixteen that are drawn), and contacts that slide with a
// coefficient above 1000 (they stick or open; u_n = mu |u_t| has mu times the error of u_t).
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Eigenvalues>

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

/// Least conditioning of a problem.
constexpr double kConditioning = 1e-5;
/// Greatest coefficient with which something slides.
constexpr double kSlides = 1000.0;
/// Velocities may differ from those of all solutions by this much of the largest speed.
constexpr double kAgreement = 1e-6;

/// A residual, of the largest speed, that means velocities to kAgreement: a residual may become a velocity error of its size
/// over the conditioning, and of some 25 times as much where a cone is narrow or wide. No less than what rounding leaves.
double tolerance_for(double conditioning) { return std::clamp(0.04 * kAgreement * conditioning, 2e-12, 1e-9); }

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
  double conditioning = 1.0;  ///< of N
  std::vector<double> guess;  ///< may lie outside of what impulses may be
};

/// The smallest eigenvalue of N over the largest, of those that are not zero, with every unit in its own mass as the judge has
/// it [1]. A residual may become a velocity error of up to its inverse times its size.
double conditioning(const CcpProblem& problem) {
  const std::vector<std::vector<double>> columns = columns_of(problem);
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  std::vector<double> root(columns.size(), 0.0);
  const auto fill = [&](std::size_t first, std::size_t rows, double trace) {
    for (std::size_t k = first; k < first + rows && trace > 0.0; ++k)
      root[k] = std::sqrt(static_cast<double>(rows) / trace);
  };
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) fill(3 * i, 3, delassus.traces()[i]);
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    const CcpBlock& block = problem.blocks[i];
    fill(first_row(problem, block), block.rows, delassus.traces()[problem.contacts.size() + i]);
  }
  const auto size = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd n(size, size);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      double value = columns[j][i];
      if (i == j && !problem.compliance.empty()) value += problem.compliance[i];
      n(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = root[i] * value * root[j];
    }
  }
  if (size == 0) return 1.0;
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>{n, Eigen::EigenvaluesOnly}.eigenvalues();
  double least = values.maxCoeff();
  for (const double value : values) {
    if (value > 1e-13 * values.maxCoeff()) least = std::min(least, value);
  }
  return values.maxCoeff() > 0.0 ? least / values.maxCoeff() : 1.0;
}

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
  what.slides = kSlides;
  what.repeats = 0.3 * below(0, 2);
  what.seed = *rc::gen::arbitrary<std::uint64_t>();
  Trial trial{planted_problem(what), {}, 0.0, 0.0, {}};
  trial.problem = below(0, 3) == 0 ? with_matrix(trial.planted.problem) : trial.planted.problem;
  trial.conditioning = conditioning(trial.problem.view());
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

/// Asserts what every solver owes; returns how it ended.
SolveSummary solve_trial(const PluginEntry& entry, const Trial& trial, int max_iterations) {
  const CcpProblem problem = trial.problem.view();
  const std::unique_ptr<CcpSolver> solver = make(entry);
  std::vector<double> gamma = trial.guess, start = trial.guess;
  SolveContext context;
  context.tolerance = tolerance_for(trial.conditioning) * trial.speed;
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
  out << "problem " << problem << ", conditioning " << trial.conditioning << ", " << name << ": "
      << to_string(summary.status) << " after " << summary.iterations << ", residual " << summary.residual / trial.speed
      << " of the largest speed, asked " << tolerance_for(trial.conditioning);
  return out.str();
}

// A thousand problems and more, of those that are drawn. The long tests give each solver the iterations that it needs: then at
// least three converge on all, and what the others missed is printed.
TEST(feasible_problems, solvers_that_report_convergence_agree_and_the_others_say_so) {
  const bool to_the_end = std::getenv("SCREE_TRIALS") != nullptr;
  ASSERT_EQ(::setenv("RC_PARAMS", ("seed=3 max_success=" + std::to_string(trials(1100))).c_str(), 0), 0);
  std::map<std::string, int> converged;
  int count = 0;
  EXPECT_TRUE(rc::check("feasible problems", [&] {
    const Trial trial = draw_trial();
    if (!(trial.conditioning > kConditioning)) return;
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
