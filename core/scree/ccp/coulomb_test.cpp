// Exact Coulomb friction over a solver of CCPs: closed forms, the conditions themselves, and honest reports.
#include "scree/ccp/coulomb.hpp"

#include <gtest/gtest.h>

#include <random>

#include "scree/ccp/judge.hpp"
#include "scree/ccp/matrix.hpp"
#include "support/ccp_problems.hpp"
#include "support/plain_ccp_solver.hpp"

namespace scree {
namespace {

using test::solve_plainly;
using test::TestingProblem;

SolveSummary plainly(const CcpProblem& problem, const InnerGoal& goal, std::span<double> gamma) {
  return solve_plainly(problem, goal.tolerance, goal.max_iterations, gamma);
}

struct Answer {
  CoulombSummary summary;
  std::vector<double> gamma, u;
  CcpFigures figures;
};

Answer solve(const CcpProblem& problem, const CoulombLimits& limits, const InnerSolve& inner = plainly) {
  const Executor executor{1};
  Answer a;
  a.gamma.assign(problem.rows(), 0.0);
  a.u.resize(problem.rows());
  a.summary = CoulombIteration{}.solve(problem, executor, inner, limits, a.gamma);
  a.figures = CcpJudge{}.figures(problem, a.gamma, nullptr);
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  delassus.apply(a.gamma, a.u);
  for (std::size_t k = 0; k < a.u.size(); ++k) a.u[k] += problem.r[k];
  return a;
}

double norm_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

CoulombLimits to(double tolerance) { return {.tolerance = tolerance, .max_solves = 100, .max_iterations = 2'000'000}; }

// A mass that slides at 3 m/s and falls at 1 m/s: m stops the fall, friction takes mu times that from the slip. The associated
// answer would let it separate.
TEST(coulomb, sliding_mass_keeps_to_the_plane) {
  TestingProblem t;
  const std::uint32_t floor = t.add_immovable(), body = t.add_body(2.0, {1, 1, 1});
  t.add_contact(floor, body, {0, 0, 1}, {}, {}, 0.5, {-1.0, 3.0, 0.0});
  const Answer a = solve(t.view(), to(1e-12));
  EXPECT_EQ(a.summary.solve.status, SolveStatus::converged);
  EXPECT_NEAR(a.gamma[0], 2.0, 1e-11);
  EXPECT_NEAR(a.gamma[1], -1.0, 1e-11);
  EXPECT_NEAR(a.u[0], 0.0, 1e-11);
  EXPECT_NEAR(a.u[1], 2.5, 1e-11);
  EXPECT_LE(a.summary.solves, 12);
}

// Normal, slip, spin and rolling without coupling, N = 1/2: u_n = 0 asks for g_n = 2; each kind of friction takes its own
// coefficient times g_n / 2 from its rate, or all of it.
TEST(coulomb, rolling_and_spinning_contact_keeps_to_the_plane) {
  const CcpBlock block{.kind = CcpKind::cone, .rows = 6, .friction = 0.5, .spinning = 0.25, .rolling = 0.125};
  const TestingProblem t = test::one_block(2.0, block, {-1.0, 3.0, 0.0, 0.125, 0.0, -2.0});
  const Answer a = solve(t.view(), to(1e-12));
  EXPECT_EQ(a.summary.solve.status, SolveStatus::converged);
  const double u[] = {0.0, 2.5, 0.0, 0.0, 0.0, -1.875};
  const double g[] = {2.0, -1.0, 0.0, -0.25, 0.0, 0.25};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(a.u[k], u[k], 1e-11) << k;
    EXPECT_NEAR(a.gamma[k], g[k], 1e-11) << k;
  }
}

// Signorini's and Coulomb's conditions themselves, on random problems; the tolerance is that of the residual, in m/s, carried
// over to impulses by masses between 1 and 10.
TEST(coulomb, random_problems_meet_signorini_and_coulomb) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TestingProblem t = test::random_problem({.bodies = 8, .contacts = 14, .seed = seed});
    const Answer a = solve(t.view(), to(1e-9));
    ASSERT_EQ(a.summary.solve.status, SolveStatus::converged) << seed;
    EXPECT_LE(a.figures.coulomb_residual, 1e-9);
    EXPECT_NEAR(a.summary.error, a.figures.coulomb_residual, 1e-13);
    for (std::size_t i = 0; i < t.contacts.size(); ++i) {
      const Vec3 g = load_block(a.gamma, i), u = load_block(a.u, i);
      const double mu = t.contacts[i].friction, slip = std::hypot(u.y, u.z), held = std::hypot(g.y, g.z);
      EXPECT_GE(u.x, -1e-8) << seed << ' ' << i;
      EXPECT_LE(held, mu * g.x + 1e-12);
      EXPECT_LE(g.x * u.x, 1e-7 * (1.0 + g.x));
      if (slip > 1e-6 && g.x > 1e-6) {
        EXPECT_NEAR(g.y * u.y + g.z * u.z, -mu * g.x * slip, 1e-7 * (1.0 + g.x));
      }
    }
  }
}

// An answer of the exact problem is one of the associated problem that has its s in r.
TEST(coulomb, answer_is_complementary_in_the_exact_problem) {
  const TestingProblem t = test::random_problem({.bodies = 8, .contacts = 14, .seed = 2});
  const Answer a = solve(t.view(), to(1e-10));
  CcpProblem exact = t.view();
  const std::vector<double> r = exact_r(exact, a.gamma, nullptr);
  exact.r = r;
  const CcpFigures figures = CcpJudge{}.figures(exact, a.gamma, nullptr);
  EXPECT_NEAR(figures.residual, a.figures.coulomb_residual, 1e-13);
  EXPECT_NEAR(figures.relative_residual * norm_of(r), a.figures.coulomb_error * norm_of(t.r), 1e-12);
  EXPECT_LE(figures.velocity_violation, 1e-9);
  EXPECT_LE(figures.complementarity_gap, 1e-7);
  EXPECT_GT(a.figures.velocity_violation, 1e-3) << "something slides";
}

TEST(coulomb, says_how_far_it_got) {
  const TestingProblem t = test::random_problem({.bodies = 8, .contacts = 14, .seed = 3});
  CoulombLimits limits = to(1e-12);
  limits.max_solves = 1;
  const Answer few = solve(t.view(), limits);
  EXPECT_EQ(few.summary.solve.status, SolveStatus::iteration_limit);
  EXPECT_EQ(few.summary.solves, 1);
  EXPECT_NEAR(few.summary.error, few.figures.coulomb_residual, 1e-13);
  EXPECT_GT(few.summary.error, 1e-12);
  limits = to(1e-12);
  limits.max_iterations = 7;
  const Answer short_of = solve(t.view(), limits);
  EXPECT_EQ(short_of.summary.solve.status, SolveStatus::iteration_limit);
  EXPECT_EQ(short_of.summary.solve.iterations, 7);
}

// A solver that cannot get below 1e-3: the iteration ends by itself, with the best answer that it saw.
TEST(coulomb, ends_when_the_solver_leads_nowhere) {
  const TestingProblem t = test::random_problem({.bodies = 8, .contacts = 14, .seed = 3});
  double least = std::numeric_limits<double>::infinity();
  const CcpProblem problem = t.view();
  const InnerSolve poor = [&](const CcpProblem& posed, const InnerGoal& goal, std::span<double> gamma) {
    const SolveSummary summary = solve_plainly(posed, std::max(1e-3, goal.tolerance), goal.max_iterations, gamma);
    least = std::min(least, CcpJudge{}.figures(problem, gamma, nullptr).coulomb_residual);
    return summary;
  };
  CoulombLimits limits = to(1e-9);
  limits.max_solves = 10'000;
  const Answer a = solve(problem, limits, poor);
  EXPECT_EQ(a.summary.solve.status, SolveStatus::stalled);
  EXPECT_NEAR(a.figures.coulomb_residual, least, 1e-13);
}

TEST(coulomb, failure_of_the_solver_ends_it) {
  const TestingProblem t = test::random_problem({.bodies = 4, .contacts = 5});
  int calls = 0;
  const Answer a = solve(t.view(), to(1e-9), [&](const CcpProblem&, const InnerGoal&, std::span<double> gamma) {
    ++calls;
    std::fill(gamma.begin(), gamma.end(), 0.0);
    return SolveSummary{SolveStatus::numerical_failure, 1, 1.0};
  });
  EXPECT_EQ(a.summary.solve.status, SolveStatus::numerical_failure);
  EXPECT_EQ(calls, 1);
}

/// R R^T of rank 7 with a skew part of `skew` times its size within its range, over `contacts` contacts.
struct SkewProblem {
  std::vector<CcpBlock> blocks;
  CcpMatrixStore matrix;
  std::vector<double> r;

  SkewProblem(std::uint32_t contacts, double skew) {
    std::mt19937_64 random{11};
    std::normal_distribution<double> normal;
    constexpr std::size_t kRank = 7;
    const std::uint32_t rows = 3 * contacts;
    std::vector<std::array<double, kRank>> root(rows);
    for (auto& row : root) {
      for (double& x : row) x = normal(random);
    }
    std::vector<MatrixEntry> entries;
    for (std::uint32_t i = 0; i < rows; ++i) {
      for (std::uint32_t j = 0; j < rows; ++j) {
        double n = 0.0;
        for (std::size_t k = 0; k < kRank; ++k) n += root[i][k] * root[j][k];
        // A rotation of the first two directions of the range.
        n += skew * (root[i][0] * root[j][1] - root[i][1] * root[j][0]);
        entries.push_back({i, j, n});
      }
    }
    for (std::uint32_t c = 0; c < contacts; ++c) {
      blocks.push_back({.kind = CcpKind::cone, .rows = 3, .first_row = 3 * c, .friction = 0.5});
    }
    matrix = make_matrix(blocks, entries);
    // Feasible: R times something, with room in K*.
    std::array<double, kRank> v{};
    for (double& x : v) x = normal(random);
    for (std::uint32_t i = 0; i < rows; ++i) {
      double value = i % 3 == 0 ? 0.2 : 0.0;
      for (std::size_t k = 0; k < kRank; ++k) value += root[i][k] * v[k];
      r.push_back(value);
    }
  }
  [[nodiscard]] CcpProblem view() const {
    CcpProblem problem;
    problem.r = r;
    problem.blocks = blocks;
    problem.matrix = matrix.view();
    return problem;
  }
};

TEST(coulomb, matrix_that_is_not_quite_symmetric_is_solved_as_it_is) {
  const SkewProblem skew{8, 0.05};
  ASSERT_GT(asymmetry(skew.view().matrix, skew.blocks), 1e-3);
  for (const bool coulomb : {false, true}) {
    CoulombLimits limits = to(1e-9);
    limits.coulomb = coulomb;
    const Answer a = solve(skew.view(), limits);
    EXPECT_EQ(a.summary.solve.status, SolveStatus::converged);
    EXPECT_LE(coulomb ? a.figures.coulomb_residual : a.figures.residual, 1e-9);
    EXPECT_GT(a.summary.solves, 1);
  }
}

TEST(coulomb, symmetric_associated_problem_is_one_solve) {
  const SkewProblem symmetric{8, 0.0};
  CoulombLimits limits = to(1e-9);
  limits.coulomb = false;
  const Answer a = solve(symmetric.view(), limits);
  EXPECT_EQ(a.summary.solves, 1);
  EXPECT_EQ(a.summary.solve.status, SolveStatus::converged);
  EXPECT_LE(a.figures.residual, 1e-9);
}

// A linear map of three dimensions: after as many differences the secant method is exact.
TEST(anderson_mixing, linear_map_of_three_dimensions_is_solved_by_four_steps) {
  const double matrix[3][3] = {{0.9, 0.05, 0.0}, {-0.3, 0.5, 0.2}, {0.1, 0.0, -1.5}};
  std::vector<double> s{1.0, 2.0, 3.0}, f(3);
  AndersonMixing mixing;
  mixing.restart(3);
  for (int k = 0; k < 5; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      f[i] = 1.0 - s[i];
      for (std::size_t j = 0; j < 3; ++j) f[i] += matrix[i][j] * s[j];
    }
    if (k < 4) mixing.advance(s, f, 1.0);
  }
  for (const double x : f) EXPECT_NEAR(x, 0.0, 1e-10);
}

}  // namespace
}  // namespace scree
