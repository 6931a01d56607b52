// What a CcpSolver owes for blocks of every kind and for problems without bodies. Part of ccp_solver_conformance.hpp. A
// method that does not take them goes without these checks.
#pragma once

#include "conformance/ccp_solver_case.hpp"
#include "support/allocation_count.hpp"
#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_planted_problems.hpp"

namespace scree::test {

/// Blocks of every kind, the cones of every number of rows.
inline std::vector<CcpBlock> blocks_of_every_kind() {
  std::vector<CcpBlock> blocks;
  for (const CcpKind kind : {CcpKind::free, CcpKind::nonnegative, CcpKind::box}) {
    for (const std::uint8_t rows : std::initializer_list<std::uint8_t>{1, 2, 4, 6}) {
      blocks.push_back({.kind = kind, .rows = rows, .lower = -0.3, .upper = 0.2});
    }
  }
  for (const std::uint8_t rows : std::initializer_list<std::uint8_t>{1, 2, 3, 5, 6}) {
    blocks.push_back({.kind = CcpKind::cone, .rows = rows, .friction = 0.5, .spinning = 0.1, .rolling = 0.2});
    blocks.push_back({.kind = CcpKind::cone, .rows = rows});
  }
  return blocks;
}

inline std::vector<double> normal_numbers(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::normal_distribution<double> normal;
  std::vector<double> values(count);
  for (double& value : values) value = normal(random);
  return values;
}

// N = 1/m on every row: the least of |g + m r|^2 / 2 m over the block's set is the projection of -m r.
TEST_P(CcpSolverConformance, a_block_of_unit_rows_is_solved_by_its_projection) {
  if (!takes_blocks(*solver_)) GTEST_SKIP() << "takes no blocks";
  const double m = 0.4;
  for (const CcpBlock& block : blocks_of_every_kind()) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const TestingProblem with_body = one_block(m, block, normal_numbers(block.rows, seed));
      const TestingProblem explicit_n = with_matrix(with_body);
      std::vector<double> expected = with_body.r;
      for (double& g : expected) g *= -m;
      project_block(block, expected);
      for (const TestingProblem& t : {with_body, explicit_n}) {
        const Solved s = solve(*solver_, t.view(), 1e-12);
        EXPECT_EQ(s.summary.status, SolveStatus::converged);
        for (std::size_t k = 0; k < expected.size(); ++k) {
          EXPECT_NEAR(s.gamma[k], expected[k], 1e-11) << "kind " << int(block.kind) << ", rows " << int{block.rows};
        }
      }
    }
  }
}

// Two spheres on top of each other and the upper one welded to a third: the floor stops all that falls, the weld passes on
// the momentum of the third.
TEST_P(CcpSolverConformance, a_weld_passes_the_momentum_that_it_holds) {
  if (!takes_blocks(*solver_)) GTEST_SKIP() << "takes no blocks";
  const double m = 0.2, v = 0.3;
  TestingProblem t;
  const std::uint32_t floor = t.add_immovable();
  const std::uint32_t low = t.add_body(m, {1e-3, 1e-3, 1e-3}), high = t.add_body(2.0 * m, {2e-3, 2e-3, 2e-3});
  const std::uint32_t welded = t.add_body(3.0 * m, {3e-3, 3e-3, 3e-3});
  t.add_contact(floor, low, {0, 0, 1}, {}, {0, 0, -0.1}, 0.4, {-v, 0, 0});
  t.add_contact(low, high, {0, 0, 1}, {0, 0, 0.1}, {0, 0, -0.1}, 0.4, {});
  // Midway between both centres.
  const std::vector<CcpRow> weld = rows_at_a_point(6, false, {0, 0, 1}, {0, 0, 0.1}, {0, 0, -0.1}, 0.1);
  t.add_block({.kind = CcpKind::free, .a = high, .b = welded}, weld, std::vector<double>(6, 0.0));
  const Solved s = solve(*solver_, t.view(), 1e-11);
  EXPECT_EQ(s.summary.status, SolveStatus::converged);
  EXPECT_NEAR(s.gamma[0], 6.0 * m * v, 1e-9);
  EXPECT_NEAR(s.gamma[3], 5.0 * m * v, 1e-9);
  EXPECT_NEAR(s.gamma[6], 3.0 * m * v, 1e-9);
}

// The KKT conditions by their own figures; the residual bounds them as it does for contacts.
TEST_P(CcpSolverConformance, planted_problems_of_every_kind_converge_to_their_optimality_conditions) {
  if (!takes_blocks(*solver_)) GTEST_SKIP() << "takes no blocks";
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PlantedProblem planted =
        planted_problem({.bodies = 12, .contacts = 6, .blocks = 6, .compliant = seed % 3 == 0, .seed = seed});
    const TestingProblem explicit_n = with_matrix(planted.problem);
    for (const TestingProblem& t : {planted.problem, explicit_n}) {
      const Solved s = solve(*solver_, t.view(), 1e-7);
      EXPECT_EQ(s.summary.status, SolveStatus::converged) << "seed " << seed << ", residual " << s.summary.residual;
      const CcpFigures figures = CcpJudge{}.figures(t.view(), s.gamma, nullptr);
      double size = 0.0;
      for (const double g : s.gamma) size += std::abs(g);
      EXPECT_LE(figures.residual, 1.01e-7);
      EXPECT_LE(figures.impulse_violation, 1e-13 * size);
      EXPECT_LE(figures.velocity_violation, 1e-6);
      EXPECT_LE(figures.complementarity_gap, 1e-6 * size);
    }
  }
}

TEST_P(CcpSolverConformance, objective_with_blocks_is_never_above_that_of_the_projected_guess) {
  if (!takes_blocks(*solver_)) GTEST_SKIP() << "takes no blocks";
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PlantedProblem planted = planted_problem(
        {.bodies = 20, .contacts = 30, .blocks = 20, .mass_decades = 4.0, .repeats = 0.2, .seed = seed});
    const TestingProblem t = seed % 2 == 0 ? with_matrix(planted.problem) : planted.problem;
    const CcpProblem p = t.view();
    expect_never_above(*solver_, p, normal_numbers(p.rows(), seed), "seed " + std::to_string(seed));
  }
}

TEST_P(CcpSolverConformance, two_threads_give_the_bits_of_one_with_blocks_and_a_second_solve_asks_for_no_memory) {
  if (!takes_blocks(*solver_)) GTEST_SKIP() << "takes no blocks";
  const PlantedProblem planted = planted_problem({.bodies = 3000, .contacts = 4000, .blocks = 3000, .reach = 6});
  const Executor one{1}, two{2};
  const Solved a = solve(*solver_, planted.problem.view(), 0.0, 10, &one);
  const Solved b = solve(*GetParam().make(), planted.problem.view(), 0.0, 10, &two);
  EXPECT_EQ(a.gamma, b.gamma);
  EXPECT_EQ(a.summary.residual, b.summary.residual);
  EXPECT_NEAR(a.summary.residual, ccp_residual(planted.problem.view(), a.gamma), 1e-12 * a.summary.residual);
  const auto allocations = [&](int limit) {
    const std::uint64_t before = allocation_count();
    solve(*solver_, planted.problem.view(), 0.0, limit);
    return allocation_count() - before;
  };
  EXPECT_EQ(allocations(10), allocations(5));
}

TEST_P(CcpSolverConformance, numbers_of_blocks_that_are_not_finite_are_reported_and_never_returned) {
  if (!takes_blocks(*solver_)) GTEST_SKIP() << "takes no blocks";
  TestingProblem t = planted_problem({.bodies = 8, .contacts = 5, .blocks = 5}).problem;
  std::vector<double> gamma(t.view().rows(), std::nan(""));
  SolveContext context;
  EXPECT_NE(solver_->solve(t.view(), context, gamma).status, SolveStatus::numerical_failure);
  for (const double g : gamma) EXPECT_TRUE(std::isfinite(g));
  t.r.back() = std::nan("");
  EXPECT_EQ(solver_->solve(t.view(), context, gamma).status, SolveStatus::numerical_failure);
  for (const double g : gamma) EXPECT_TRUE(std::isfinite(g));
}

// A block whose rows no body feels, beside one that is solved by its projection.
TEST_P(CcpSolverConformance, block_without_effect_does_no_harm) {
  if (!takes_blocks(*solver_)) GTEST_SKIP() << "takes no blocks";
  for (const CcpKind kind : {CcpKind::free, CcpKind::nonnegative, CcpKind::box, CcpKind::cone}) {
    TestingProblem t = one_block(0.4, {}, {-1.0, 2.0, 3.0});
    t.add_block({.kind = kind, .friction = 0.5, .lower = -1.0, .upper = 1.0}, std::vector<CcpRow>(3), {-1.0, 0.5, 0.0});
    for (const TestingProblem& form : {t, with_matrix(t)}) {
      const Solved s = solve(*solver_, form.view(), 1e-12);
      EXPECT_EQ(s.summary.status, SolveStatus::converged);
      EXPECT_NEAR(s.gamma[0], 0.4, 1e-11);
      EXPECT_NEAR(s.gamma[2], -1.2, 1e-11);
      for (const double g : s.gamma) EXPECT_TRUE(std::isfinite(g));
    }
  }
}

}  // namespace scree::test
