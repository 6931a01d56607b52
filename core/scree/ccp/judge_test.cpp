// The judge's figures against closed forms. Residuals themselves are tested with the operator (delassus_test.cpp).
#include "scree/ccp/judge.hpp"

#include <gtest/gtest.h>

#include "support/ccp_problems.hpp"

namespace scree {
namespace {

using test::random_problem;
using test::sphere_on_floor;
using test::TestingProblem;

CcpFigures figures_of(const TestingProblem& t, const std::vector<double>& gamma) {
  return CcpJudge{}.figures(t.view(), gamma, nullptr);
}

// Without impulse u = r = (-v, w, 0), and P(-u) = P(v, -w, 0). With w <= mu v this is (v, -w, 0) itself, of length ||r||.
TEST(ccp_figures, relative_residual_of_no_impulse_is_one_when_minus_r_is_in_the_cone) {
  const CcpFigures figures = figures_of(sphere_on_floor(0.3, 0.1, 0.5, {-2.0, 0.8, 0.0}), {0.0, 0.0, 0.0});
  EXPECT_NEAR(figures.relative_residual, 1.0, 1e-15);
  EXPECT_EQ(figures.objective, 0.0);
}

// The same with De Saxce's velocity: the normal part is -v + mu w, so that P(v - mu w, -w, 0) counts. mu = 1/2, v = 2, w = 1.
TEST(ccp_figures, coulomb_error_of_no_impulse_takes_the_sliding_speed_off_the_approach) {
  const CcpFigures figures = figures_of(sphere_on_floor(0.3, 0.1, 0.5, {-2.0, 1.0, 0.0}), {0.0, 0.0, 0.0});
  // (1.5, -1): outside of the cone, n = (1.5 + 0.5) / 1.25 = 1.6, t = -0.8.
  EXPECT_NEAR(figures.coulomb_error, std::hypot(1.6, 0.8) / std::hypot(2.0, 1.0), 1e-15);
}

// A sphere that slides: the floor's tangential row needs 3.5 / m, the normal one 1 / m. Exact Coulomb friction stops the
// normal velocity, g_n = m v, and g_t = -mu g_n against the sliding; the associated problem lifts it by mu times the sliding.
TEST(ccp_figures, each_law_is_zero_at_its_own_closed_form_only) {
  const double m = 0.3, mu = 0.2, v = 1.0, w = 4.0;
  const TestingProblem t = sphere_on_floor(m, 0.1, mu, {-v, w, 0.0});
  const double lifted = m * (v + mu * w) / (1.0 + 3.5 * mu * mu);
  const CcpFigures associated = figures_of(t, {lifted, -mu * lifted, 0.0});
  const CcpFigures coulomb = figures_of(t, {m * v, -mu * m * v, 0.0});
  // Rounding of numbers of order one.
  EXPECT_NEAR(associated.relative_residual, 0.0, 1e-15);
  EXPECT_NEAR(coulomb.coulomb_error, 0.0, 1e-15);
  EXPECT_GT(associated.coulomb_error, 1e-2);
  EXPECT_GT(coulomb.relative_residual, 1e-2);
}

// At a solution gamma . u = 0, hence 1/2 gamma^T N gamma + r^T gamma = 1/2 r^T gamma; head-on: -1/2 m v^2, the energy lost.
TEST(ccp_figures, objective_of_a_stopped_sphere_is_its_energy_lost) {
  const double m = 0.3, v = 2.0;
  EXPECT_NEAR(figures_of(sphere_on_floor(m, 0.1, 0.5, {-v, 0.0, 0.0}), {m * v, 0.0, 0.0}).objective, -0.5 * m * v * v,
              1e-15);
}

TEST(ccp_figures, agree_with_the_residual_and_the_operator) {
  const TestingProblem t = random_problem({.bodies = 20, .contacts = 50, .compliant = true, .seed = 8});
  const std::vector<double> gamma(t.view().rows(), 0.3);
  DelassusOperator delassus;
  delassus.bind(t.view(), nullptr);
  const CcpFigures figures = figures_of(t, gamma);
  EXPECT_EQ(figures.residual, ccp_residual(t.view(), gamma));
  // The same terms in another order.
  EXPECT_NEAR(figures.objective, delassus.objective(gamma), 1e-13 * std::abs(figures.objective));
}

TEST(ccp_figures, have_the_bits_of_one_thread_for_two) {
  const TestingProblem t = random_problem({.bodies = 3000, .contacts = 9000, .seed = 9});
  const std::vector<double> gamma(t.view().rows(), 0.1);
  const Executor two{2};
  const CcpFigures a = figures_of(t, gamma), b = CcpJudge{}.figures(t.view(), gamma, &two);
  EXPECT_EQ(a.residual, b.residual);
  EXPECT_EQ(a.relative_residual, b.relative_residual);
  EXPECT_EQ(a.coulomb_error, b.coulomb_error);
  EXPECT_EQ(a.objective, b.objective);
}

// Nothing to stop and nothing done: zero, not 0 / 0.
TEST(ccp_figures, of_a_problem_without_r_are_not_divided_by_it) {
  const TestingProblem t = sphere_on_floor(0.3, 0.1, 0.5, {0.0, 0.0, 0.0});
  EXPECT_EQ(figures_of(t, {0.0, 0.0, 0.0}).relative_residual, 0.0);
  EXPECT_GT(figures_of(t, {0.1, 0.0, 0.0}).relative_residual, 0.0);
}

}  // namespace
}  // namespace scree
