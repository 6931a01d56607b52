// spg: the conformance suite of CCP solvers in its scalings and steps, and what is its own.
#include "spg.hpp"

#include "conformance/ccp_solver_conformance.hpp"

namespace scree::test {

using Scaling = SpgOptions::Scaling;
using Step = SpgOptions::Step;

INSTANTIATE_TEST_SUITE_P(
    spg, CcpSolverConformance,
    testing::Values(SolverCase{"block", [] { return std::make_unique<Spg>(SpgOptions{}); }},
                    SolverCase{"contact", [] { return std::make_unique<Spg>(SpgOptions{.scaling = Scaling::unit}); }},
                    SolverCase{"none", [] { return std::make_unique<Spg>(SpgOptions{.scaling = Scaling::none}); }},
                    SolverCase{"bb2", [] { return std::make_unique<Spg>(SpgOptions{.step = Step::bb2}); }},
                    SolverCase{"alternating",
                               [] { return std::make_unique<Spg>(SpgOptions{.step = Step::alternating, .hold = 1}); }},
                    SolverCase{"monotone", [] { return std::make_unique<Spg>(SpgOptions{.memory = 1}); }}),
    solver_case_name);

// A body pressed against a wall by k contacts at one point: N is k times its diagonal in the direction of all ones, so that the
// first step, of length one, overshoots k times and must be refused for k > 2.
TEST(spg, line_search_refuses_the_first_step_onto_many_contacts_at_one_point) {
  TestingProblem t;
  const auto wall = t.add_immovable(), body = t.add_body(2.0, {1, 1, 1});
  for (int k = 0; k < 8; ++k) t.add_contact(wall, body, {0, 0, 1}, {}, {}, 0.3, {-1.0, 0, 0});
  Spg solver{SpgOptions{}};
  const Solved s = solve(solver, t.view(), 1e-12);
  EXPECT_GE(solver.reductions(), 1);
  EXPECT_EQ(s.summary.status, SolveStatus::converged);
  double sum = 0.0;
  for (std::size_t i = 0; i < 8; ++i) sum += s.gamma[3 * i];
  EXPECT_NEAR(sum, 2.0, 1e-11);  // m v, however it is shared
}

// What the search is for: it triggers beyond the first step, and less often the more iterates it remembers; with BB1, whose steps are
// long.
TEST(spg, longer_memory_refuses_fewer_steps) {
  int monotone = 0, remembering = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TestingProblem t = random_problem({.bodies = 30, .contacts = 80, .seed = seed});
    Spg one{SpgOptions{.hold = 1, .memory = 1}}, ten{SpgOptions{.hold = 1}};
    EXPECT_EQ(solve(one, t.view(), 1e-8).summary.status, SolveStatus::converged);
    EXPECT_EQ(solve(ten, t.view(), 1e-8).summary.status, SolveStatus::converged);
    monotone += one.reductions(), remembering += ten.reductions();
  }
  EXPECT_GT(remembering, 10);
  EXPECT_GT(monotone, remembering);
}

TEST(spg, scaling_needs_fewer_iterations_over_six_decades_of_mass) {
  const TestingProblem t = random_problem({.bodies = 20, .contacts = 40, .mass_decades = 6.0, .seed = 12});
  Spg scaled{SpgOptions{}}, plain{SpgOptions{.scaling = Scaling::none}};
  const Solved a = solve(scaled, t.view(), 1e-8, 100000);
  const Solved b = solve(plain, t.view(), 1e-8, 100000);
  EXPECT_EQ(a.summary.status, SolveStatus::converged);
  EXPECT_LT(4 * a.summary.iterations, b.summary.iterations);
}

}  // namespace scree::test
