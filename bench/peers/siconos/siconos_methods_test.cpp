// Every solver of Siconos that the comparison knows: which model of friction it solves, on problems with known answers. It also
// guards the declarations of siconos_declared.hpp.
#include "siconos_methods.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scree/base/error.hpp"
#include "scree/ccp/judge.hpp"
#include "support/ccp_problems.hpp"

namespace scree {
namespace {

// Without the contacts that have no friction: Siconos' interior point divides by the coefficients.
test::TestingProblem with_friction(test::TestingProblem problem) {
  for (std::size_t i = problem.contacts.size(); i-- > 0;) {
    if (problem.contacts[i].friction > 0.0) continue;
    problem.contacts.erase(problem.contacts.begin() + static_cast<std::ptrdiff_t>(i));
    const auto row = problem.r.begin() + static_cast<std::ptrdiff_t>(3 * i);
    problem.r.erase(row, row + 3);
  }
  return problem;
}

class SiconosMethods : public testing::TestWithParam<SiconosMethod> {};

// A sphere of mass m hits the floor with 1 m/s and slides with 1 m/s: N = diag(1, 3.5, 3.5) / m. Coulomb: g_n = m. Associated:
// u_n = mu |u_t|, so g_n (1 + 3.5 mu^2) = m (1 + mu). The two differ by 5 %.
TEST_P(SiconosMethods, solve_the_model_that_the_table_says) {
  const double m = 0.7, mu = 0.2;
  const test::TestingProblem sphere = test::sphere_on_floor(m, 0.01, mu, {-1.0, 1.0, 0.0});
  const CcpProblem problem = sphere.view();
  const SiconosAnswer answer = SiconosSolver{GetParam(), problem}.solve(1e-10, 100000);
  const double normal = GetParam().exact ? m : m * (1.0 + mu) / (1.0 + 3.5 * mu * mu);
  EXPECT_NEAR(answer.gamma[0], normal, 1e-6 * m);  // 1e-10 of their own measure leaves room for its scale
  EXPECT_NEAR(std::hypot(answer.gamma[1], answer.gamma[2]), mu * normal, 1e-6 * m);
  EXPECT_GE(answer.seconds, 0.0);
}

// Ten bodies, twenty contacts in all directions, so that rows, cones and matrices have to stand in their places.
TEST_P(SiconosMethods, find_answers_that_the_judge_accepts) {
  test::TestingProblem random = test::random_problem({.bodies = 10, .contacts = 20, .seed = 3});
  if (GetParam().name == "global_ipm") random = with_friction(random);
  const CcpProblem problem = random.view();
  const SiconosAnswer answer = SiconosSolver{GetParam(), problem}.solve(1e-8, 100000);
  const CcpFigures figures = CcpJudge{}.figures(problem, answer.gamma, nullptr);
  const double start = CcpJudge{}.residual(problem, std::vector<double>(problem.rows(), 0.0), nullptr);
  EXPECT_LT(GetParam().exact ? figures.coulomb_residual : figures.residual, 1e-4 * start);
}

INSTANTIATE_TEST_SUITE_P(all, SiconosMethods, testing::ValuesIn(siconos_methods().begin(), siconos_methods().end()),
                         [](const auto& method) { return std::string{method.param.name}; });

TEST(siconos_problem, blocks_and_compliance_are_refused_where_there_is_no_place_for_them) {
  test::TestingProblem sphere = test::sphere_on_floor(1.0, 0.01, 0.2, {-1.0, 1.0, 0.0});
  sphere.compliance = {0.1, 0.0, 0.0};
  const CcpProblem compliant = sphere.view();
  EXPECT_NO_THROW(LocalForm{compliant});
  EXPECT_THROW(GlobalForm{compliant}, Error);
  const test::TestingProblem joint = test::one_block(1.0, {}, {1.0, 0.0, 0.0});
  const CcpProblem blocks = joint.view();
  EXPECT_THROW(LocalForm{blocks}, Error);
}

}  // namespace
}  // namespace scree
