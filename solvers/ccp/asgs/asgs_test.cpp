// asgs: the conformance suite of CCP solvers in its orders, and what is its own.
#include "asgs.hpp"

#include "conformance/ccp_solver_conformance.hpp"
#include "scree/ccp/judge.hpp"

namespace scree::test {

INSTANTIATE_TEST_SUITE_P(
    asgs, CcpSolverConformance,
    testing::Values(SolverCase{"coloured", [] { return std::make_unique<Asgs>(AsgsOptions{.coloured = true}); }},
                    SolverCase{"momentum_only", [] { return std::make_unique<Asgs>(AsgsOptions{.conjugate = false}); }},
                    SolverCase{"double_only", [] { return std::make_unique<Asgs>(AsgsOptions{.single = false}); }},
                    SolverCase{"sweeps_only", [] { return std::make_unique<Asgs>(AsgsOptions{.relaxed = false}); }},
                    SolverCase{"plain", [] { return std::make_unique<Asgs>(AsgsOptions{.accelerated = false}); }}),
    solver_case_name);

// A column of equal spheres is the worst case of a sweep: the condition number of N grows with the square of its length. The
// momentum makes the sweeps grow with the length only; a third of plain is far from where the two laws cross.
TEST(asgs, momentum_needs_less_than_a_third_of_the_plain_sweeps_on_a_column) {
  TestingProblem t;
  std::uint32_t below = t.add_immovable();
  for (int k = 0; k < 60; ++k) {
    const std::uint32_t sphere = t.add_body(1.0, {1e-3, 1e-3, 1e-3});
    t.add_contact(below, sphere, {0, 0, 1}, k == 0 ? Vec3{} : Vec3{0, 0, 0.1}, {0, 0, -0.1}, 0.4,
                  {k == 0 ? -1.0 : 0.0, 0, 0});
    below = sphere;
  }
  Asgs accelerated{AsgsOptions{}}, plain{AsgsOptions{.accelerated = false}};
  const Solved a = solve(accelerated, t.view(), 1e-8), b = solve(plain, t.view(), 1e-8);
  EXPECT_EQ(a.summary.status, SolveStatus::converged);
  EXPECT_EQ(b.summary.status, SolveStatus::converged);
  EXPECT_LT(3 * a.summary.iterations, b.summary.iterations);
}

// Where every contact carries and none slides, conjugate steps end after as many pairs of sweeps as N has eigenvalues, one a
// contact of a column; the last pair's own sweeps, and rounding, allow for two more pairs. Momentum knows no such end.
TEST(asgs, conjugate_steps_end_after_as_many_pairs_as_there_are_eigenvalues) {
  constexpr int kLength = 12;
  TestingProblem t;
  std::uint32_t below = t.add_immovable();
  for (int k = 0; k < kLength; ++k) {
    const std::uint32_t sphere = t.add_body(1.0, {1e-3, 1e-3, 1e-3});
    t.add_contact(below, sphere, {0, 0, 1}, k == 0 ? Vec3{} : Vec3{0, 0, 0.1}, {0, 0, -0.1}, 0.4,
                  {k == 0 ? -1.0 : 0.0, 0, 0});
    below = sphere;
  }
  Asgs conjugate{AsgsOptions{.single = false, .check_interval = 2}},
      momentum{AsgsOptions{.conjugate = false, .check_interval = 2}};
  const Solved c = solve(conjugate, t.view(), 1e-12), m = solve(momentum, t.view(), 1e-12);
  EXPECT_EQ(c.summary.status, SolveStatus::converged);
  EXPECT_LE(c.summary.iterations, 2 * (kLength + 2));
  EXPECT_GT(m.summary.iterations, 4 * kLength);
}

// The guard must be needed somewhere, or this test shows nothing; where it acts, the solve converges all the same. Without the
// restart by direction it alone keeps the momentum in bounds.
TEST(asgs, pairs_that_end_uphill_are_undone_and_the_solve_converges) {
  int undone = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TestingProblem t = random_problem({.bodies = 30, .contacts = 80, .mass_decades = 2.0, .seed = seed});
    for (const bool restart : {true, false}) {
      Asgs solver{AsgsOptions{.restart = restart, .conjugate = seed % 2 == 0}};
      const Solved s = solve(solver, t.view(), 1e-9);
      EXPECT_EQ(s.summary.status, SolveStatus::converged) << "seed " << seed;
      expect_solution(t.view(), s.gamma, 1e-9);
      undone += solver.undone();
    }
  }
  EXPECT_GT(undone, 0);
}

/// A thousand columns of two equal spheres that stand on the floor, and one of ten.
TestingProblem columns() {
  TestingProblem t;
  const std::uint32_t floor = t.add_immovable();
  for (int column = 0; column <= 1000; ++column) {
    for (int k = 0; k < (column == 500 ? 10 : 2); ++k) {
      const std::uint32_t sphere = t.add_body(1.0, {1e-3, 1e-3, 1e-3});
      t.add_contact(k == 0 ? floor : sphere - 1, sphere, {0, 0, 1}, k == 0 ? Vec3{} : Vec3{0, 0, 0.1}, {0, 0, -0.1},
                    0.4, {k == 0 ? -1.0 : 0.0, 0, 0});
    }
  }
  return t;
}

// The long column needs many sweeps, and the others wait for it unless it is dealt with alone: it has 1 of 200 contacts, so
// that 600 passes over it, enough for any factor of 1e6 with a spectral radius of cos^2(pi / 21), cost three over all.
TEST(asgs, a_few_contacts_do_not_make_all_others_wait) {
  const TestingProblem t = columns();
  Asgs alone{AsgsOptions{.single = false}}, together{AsgsOptions{.relaxed = false, .single = false}};
  const Solved a = solve(alone, t.view(), 1e-6), b = solve(together, t.view(), 1e-6);
  EXPECT_EQ(a.summary.status, SolveStatus::converged);
  EXPECT_LE(ccp_residual(t.view(), a.gamma), 1e-6);
  EXPECT_LT(2 * a.summary.iterations, b.summary.iterations);
}

// The callback must tell the same story as the summary.
TEST(asgs, callback_counts_every_sweep) {
  const TestingProblem t = random_problem({.bodies = 20, .contacts = 60, .seed = 2});
  for (const int limit : {1, 2, 7, 5000}) {
    Asgs solver{AsgsOptions{}};
    std::vector<double> gamma(t.view().rows(), 0.0);
    SolveContext context;
    context.tolerance = 1e-10;
    context.max_iterations = limit;
    int calls = 0;
    context.on_iteration = [&](const IterationReport& report) { EXPECT_EQ(report.iteration, ++calls); };
    EXPECT_EQ(solver.solve(t.view(), context, gamma).iterations, calls);
    EXPECT_LE(calls, limit);
  }
}

}  // namespace scree::test
