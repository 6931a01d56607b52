// jacobi: the conformance suite of CCP solvers, and what is its own.
#include "jacobi.hpp"

#include "conformance/ccp_solver_conformance.hpp"

namespace scree::test {

INSTANTIATE_TEST_SUITE_P(
    jacobi, CcpSolverConformance,
    testing::Values(SolverCase{"default", [] { return std::make_unique<Jacobi>(JacobiOptions{}); }},
                    SolverCase{"unrelaxed", [] { return std::make_unique<Jacobi>(JacobiOptions{.relaxation = 1.0}); }}),
    solver_case_name);

// Bodies with very many contacts are where steps sized by the block alone diverge. The objective of consecutive iterates, up
// to the rounding of its sum.
TEST(jacobi, objective_falls_with_every_iteration_for_any_number_of_contacts_a_body) {
  for (const std::size_t bodies : {2, 5, 40}) {
    const TestingProblem t = random_problem({.bodies = bodies, .contacts = 200, .mass_decades = 2.0, .seed = bodies});
    std::vector<double> gamma(t.view().rows(), 0.0);
    Jacobi solver{JacobiOptions{.relaxation = 1.9}};
    SolveContext context;
    context.tolerance = 0.0;
    context.max_iterations = 1;
    double before = 0.0;
    for (int k = 0; k < 100; ++k) {
      solver.solve(t.view(), context, gamma);
      const double now = objective_of(t.view(), gamma);
      EXPECT_LE(now, before + 1e-13 * std::abs(before)) << "iteration " << k << ", " << bodies << " bodies";
      before = now;
    }
    EXPECT_LT(before, 0.0);
  }
}

// k contacts at one point of one body: the step of each is a k-th of the whole, and with omega = 1 one iteration stops it.
TEST(jacobi, contacts_at_one_point_share_the_impulse_in_one_iteration) {
  TestingProblem t;
  const auto wall = t.add_immovable(), body = t.add_body(2.0, {1, 1, 1});
  for (int k = 0; k < 8; ++k) t.add_contact(wall, body, {0, 0, 1}, {}, {}, 0.3, {-1.0, 0, 0});
  Jacobi solver{JacobiOptions{.relaxation = 1.0}};
  const Solved s = solve(solver, t.view(), 1e-14);
  EXPECT_EQ(s.summary.iterations, 1);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(s.gamma[3 * i], 0.25, 1e-15);
}

}  // namespace scree::test
