// How a CcpSolver has to behave, whatever it is given. Part of ccp_solver_conformance.hpp.
#pragma once

#include "conformance/ccp_solver_case.hpp"
#include "support/allocation_count.hpp"

namespace scree::test {

TEST_P(CcpSolverConformance, empty_problem_is_solved) {
  EXPECT_EQ(solve(*solver_, CcpProblem{}, 1e-3).summary.status, SolveStatus::converged);
}

// No impulse changes what immovable bodies do to each other, and the judge does not ask for it; the rest is solved.
TEST_P(CcpSolverConformance, contact_between_immovable_bodies_does_no_harm) {
  TestingProblem t = sphere_on_floor(0.3, 0.1, 0.5, {-2.0, 0.0, 0.0});
  const std::uint32_t wall = t.add_immovable();
  t.add_contact(0, wall, {1, 0, 0}, {}, {}, 0.5, {-1.0, 0.2, 0.0});
  const Solved s = solve(*solver_, t.view(), 1e-12);
  EXPECT_EQ(s.summary.status, SolveStatus::converged);
  EXPECT_NEAR(s.gamma[0], 0.6, 1e-12);
  for (const double g : s.gamma) EXPECT_TRUE(std::isfinite(g));
}

TEST_P(CcpSolverConformance, summary_tells_the_residual_of_the_answer) {
  const TestingProblem t = random_problem({.bodies = 50, .contacts = 150, .mass_decades = 3.0, .seed = 5});
  for (const int limit : {1, 7, 50}) {
    const Solved s = solve(*solver_, t.view(), 0.0, limit);
    EXPECT_NE(s.summary.status, SolveStatus::converged);  // rounding may also stall it
    EXPECT_LE(s.summary.iterations, limit);
    // Two sums of the same terms in different order.
    EXPECT_NEAR(s.summary.residual, ccp_residual(t.view(), s.gamma), 1e-12);
  }
}

TEST_P(CcpSolverConformance, objective_is_never_above_that_of_the_projected_guess) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TestingProblem t = random_problem({.bodies = 30, .contacts = 90, .mass_decades = 4.0, .seed = seed});
    const CcpProblem p = t.view();
    std::mt19937_64 random{seed};
    std::normal_distribution<double> normal;
    std::vector<double> guess(p.rows());
    for (double& g : guess) g = 10.0 * normal(random);
    expect_never_above(*solver_, p, guess, "seed " + std::to_string(seed));
  }
}

TEST_P(CcpSolverConformance, numbers_that_are_not_finite_are_reported_and_never_returned) {
  TestingProblem t = random_problem({.bodies = 8, .contacts = 14, .seed = 2});
  std::vector<double> gamma(t.view().rows(), std::nan(""));
  SolveContext context;
  EXPECT_NE(solver_->solve(t.view(), context, gamma).status, SolveStatus::numerical_failure);
  for (const double g : gamma) EXPECT_TRUE(std::isfinite(g));
  t.r[4] = std::nan("");
  EXPECT_EQ(solver_->solve(t.view(), context, gamma).status, SolveStatus::numerical_failure);
  for (const double g : gamma) EXPECT_TRUE(std::isfinite(g));
}

TEST_P(CcpSolverConformance, two_threads_give_the_bits_of_one) {
  const TestingProblem t = random_problem({.bodies = 3000, .immovable = 3, .contacts = 9000, .reach = 6, .seed = 9});
  const Executor one{1}, two{2};
  const Solved a = solve(*solver_, t.view(), 1e-9, 20, &one);
  const Solved b = solve(*GetParam().make(), t.view(), 1e-9, 20, &two);
  EXPECT_EQ(a.gamma, b.gamma);
  EXPECT_EQ(a.summary.residual, b.summary.residual);
}

// Once the workspace has its size, 20 iterations ask for memory as often as 60 do: never inside the loop.
TEST_P(CcpSolverConformance, iterations_allocate_nothing) {
  const TestingProblem t = random_problem({.bodies = 3000, .immovable = 3, .contacts = 9000, .reach = 6, .seed = 9});
  const auto allocations = [&](int limit) {
    const std::uint64_t before = allocation_count();
    solve(*solver_, t.view(), 0.0, limit);
    return allocation_count() - before;
  };
  ASSERT_GT(allocations(60), 0U);  // the counter counts: this solve makes the workspace
  EXPECT_EQ(allocations(60), allocations(20));
}

TEST_P(CcpSolverConformance, workspace_of_another_problem_does_not_show) {
  const TestingProblem t = random_problem({.bodies = 8, .contacts = 14, .seed = 3});
  const Solved fresh = solve(*GetParam().make(), t.view(), 1e-9, 50);
  solve(*solver_, random_problem({.bodies = 100, .contacts = 300, .compliant = true, .seed = 4}).view(), 1e-9, 50);
  const Solved again = solve(*solver_, t.view(), 1e-9, 50);
  EXPECT_EQ(fresh.gamma, again.gamma);
}

TEST_P(CcpSolverConformance, a_solved_problem_needs_no_iteration) {
  const TestingProblem t = random_problem({.bodies = 8, .contacts = 14, .seed = 6});
  Solved s = solve(*solver_, t.view(), 1e-8);
  SolveContext context;
  context.tolerance = 1.01 * s.summary.residual + 1e-14;
  EXPECT_EQ(solver_->solve(t.view(), context, s.gamma).iterations, 0);
}

}  // namespace scree::test
