// scree's coulomb_error against Siconos' own error, on impulses far from and near a solution.
#include "siconos_error.hpp"

#include <gtest/gtest.h>

#include <random>

#include "scree/ccp/coulomb.hpp"
#include "scree/ccp/fclib/fclib_ccp.hpp"
#include "scree/ccp/judge.hpp"
#include "support/plain_ccp_solver.hpp"

namespace scree {
namespace {

/// Contacts of `each` rows, W = R R^T of lower rank, q feasible with room.
FclibProblem random_local(std::size_t contacts, std::size_t each, unsigned seed) {
  std::mt19937_64 random{seed};
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform{0.1, 0.8};
  const std::size_t rows = contacts * each, rank = rows / 2 + 1;
  std::vector<std::vector<double>> root(rows, std::vector<double>(rank));
  std::vector<double> v(rank);
  for (auto& row : root) {
    for (double& x : row) x = normal(random);
  }
  for (double& x : v) x = normal(random);
  FclibLocal local;
  local.W.rows = local.W.columns = rows;
  FclibProblem problem;
  problem.spacedim = static_cast<int>(each);
  for (std::uint32_t i = 0; i < rows; ++i) {
    double q = i % each == 0 ? 0.1 : 0.0;
    for (std::size_t k = 0; k < rank; ++k) q += root[i][k] * v[k];
    local.q.push_back(q);
    for (std::uint32_t j = 0; j < rows; ++j) {
      double w = 0.0;
      for (std::size_t k = 0; k < rank; ++k) w += root[i][k] * root[j][k];
      local.W.entries.push_back({i, j, w});
    }
  }
  for (std::size_t c = 0; c < contacts; ++c) {
    problem.mu.push_back(uniform(random));
    if (each == 5) problem.rolling.push_back(0.2 * uniform(random));
  }
  problem.form = std::move(local);
  return problem;
}

void expect_agreement(std::size_t each) {
  const Executor executor{1};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const FclibProblem problem = random_local(6, each, seed);
    const FclibCcp reduced{problem, "file"};
    const CcpProblem posed = reduced.record().problem();
    std::mt19937_64 random{seed};
    std::normal_distribution<double> normal;
    std::vector<double> far(posed.rows()), near(posed.rows());
    for (double& x : far) x = normal(random);
    const InnerSolve plainly = [](const CcpProblem& p, const InnerGoal& goal, std::span<double> gamma) {
      return test::solve_plainly(p, goal.tolerance, goal.max_iterations, gamma);
    };
    const CoulombSummary solved = CoulombIteration{}.solve(
        posed, executor, plainly, {.tolerance = 1e-8, .max_solves = 200, .max_iterations = 1'000'000}, near);
    EXPECT_EQ(solved.solve.status, SolveStatus::converged) << seed;
    for (const std::vector<double>& gamma : {far, near}) {
      const double ours = CcpJudge{}.figures(posed, gamma, nullptr).coulomb_error;
      // The same sums in another order: rounding of numbers of order 10, over ||q|| of order 10.
      EXPECT_NEAR(ours, siconos_error(problem, gamma).over_q, 1e-13 * (1.0 + ours)) << seed;
    }
  }
}

TEST(siconos_error, is_our_coulomb_error) { expect_agreement(3); }
TEST(siconos_error, is_our_coulomb_error_with_rolling_friction) { expect_agreement(5); }

}  // namespace
}  // namespace scree
