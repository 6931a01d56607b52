// admm: the conformance suite of CCP solvers in variants, and how often it factorises.
#include "admm.hpp"

#include "conformance/ccp_solver_conformance.hpp"

namespace scree::test {
namespace {

INSTANTIATE_TEST_SUITE_P(
    admm, CcpSolverConformance,
    testing::Values(SolverCase{"plain", [] { return std::make_unique<Admm>(AdmmOptions{.relaxation = 1.0}); }},
                    SolverCase{"one_factor",
                               [] { return std::make_unique<Admm>(AdmmOptions{.most_factorisations = 1}); }}),
    solver_case_name);

// A penalty far from the best one is found out and corrected, with no more factorisations than allowed.
TEST(admm, balances_a_penalty_that_is_far_off) {
  const TestingProblem t = random_problem({.bodies = 30, .contacts = 60, .seed = 3});
  for (const double penalty : {1e-4, 1e4}) {
    Admm admm{AdmmOptions{.penalty = penalty, .most_factorisations = 12}};
    const Solved s = solve(admm, t.view(), 1e-9, 20000);
    EXPECT_EQ(s.summary.status, SolveStatus::converged) << "penalty " << penalty;
    EXPECT_GT(admm.factorisations(), 1);
    EXPECT_LE(admm.factorisations(), 12);
    expect_solution(t.view(), s.gamma, 1e-9);
  }
}

TEST(admm, factorises_once_when_it_may_not_balance) {
  Admm admm{AdmmOptions{.most_factorisations = 1}};
  const TestingProblem t = random_problem({.bodies = 8, .contacts = 14, .seed = 2});
  EXPECT_EQ(solve(admm, t.view(), 1e-9, 20000).summary.status, SolveStatus::converged);
  EXPECT_EQ(admm.factorisations(), 1);
}

}  // namespace
}  // namespace scree::test
