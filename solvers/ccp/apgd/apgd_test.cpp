// apgd: the conformance suite of CCP solvers, with and without its scaling.
#include "apgd.hpp"

#include "conformance/ccp_solver_conformance.hpp"

namespace scree::test {

INSTANTIATE_TEST_SUITE_P(apgd, CcpSolverConformance,
                         testing::Values(SolverCase{
                             "plain", [] { return std::make_unique<Apgd>(ApgdOptions{.scaled = false}); }}),
                         solver_case_name);

// Masses over six decades: scaling per contact is what makes such problems converge in reasonable time.
TEST(apgd, scaling_needs_fewer_iterations_over_six_decades_of_mass) {
  const TestingProblem t = random_problem({.bodies = 20, .contacts = 40, .mass_decades = 6.0, .seed = 12});
  Apgd scaled{ApgdOptions{}}, plain{ApgdOptions{.scaled = false}};
  const Solved a = solve(scaled, t.view(), 1e-8, 100000);
  const Solved b = solve(plain, t.view(), 1e-8, 100000);
  EXPECT_EQ(a.summary.status, SolveStatus::converged);
  EXPECT_LT(4 * a.summary.iterations, b.summary.iterations);
}

// The callback must tell the same story as the summary.
TEST(apgd, callback_counts_every_pass_over_the_contacts) {
  const TestingProblem t = random_problem({.bodies = 20, .contacts = 60, .seed = 2});
  Apgd solver{ApgdOptions{}};
  std::vector<double> gamma(t.view().rows(), 0.0);
  SolveContext context;
  context.tolerance = 1e-10;
  context.max_iterations = 5000;
  int calls = 0, last = 0;
  context.on_iteration = [&](const IterationReport& report) {
    EXPECT_EQ(report.iteration, last + 1);
    last = report.iteration;
    ++calls;
  };
  const SolveSummary summary = solver.solve(t.view(), context, gamma);
  EXPECT_EQ(calls, summary.iterations);
}

}  // namespace scree::test
