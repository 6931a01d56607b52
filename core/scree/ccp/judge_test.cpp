// The judge's figures against closed forms. Residuals themselves are tested with the operator (delassus_test.cpp).
#include "scree/ccp/judge.hpp"

#include <gtest/gtest.h>

#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_planted_problems.hpp"
#include "support/ccp_problems.hpp"

namespace scree {
namespace {

using test::one_block;
using test::planted_problem;
using test::PlantedProblem;
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
  const CcpProblem problem = t.view();
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// N = 1/m and s = m: the natural map of a row is an interval's, a velocity whatever the mass.
TEST(ccp_figures, rows_without_bounds_and_with_one_or_two) {
  const double m = 0.3;
  const auto residual = [&](const CcpBlock& block, double r, double g) {
    return ccp_residual(one_block(m, block, {r}).view(), std::vector<double>{g});
  };
  const CcpBlock free{.kind = CcpKind::free};
  EXPECT_NEAR(residual(free, -2.0, 0.0), 2.0, 1e-15);
  EXPECT_NEAR(residual(free, -2.0, 2.0 * m), 0.0, 1e-15);
  EXPECT_NEAR(residual(free, 2.0, -2.0 * m), 0.0, 1e-15);

  const CcpBlock push{.kind = CcpKind::nonnegative};
  EXPECT_NEAR(residual(push, -2.0, 0.0), 2.0, 1e-15);
  EXPECT_NEAR(residual(push, -2.0, 2.0 * m), 0.0, 1e-15);
  EXPECT_NEAR(residual(push, 2.0, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(residual(push, 2.0, -2.0 * m), 2.0, 1e-15);  // it must not pull: P(g) = 0

  // A motor that stops 2 m/s needs 2 m; it has less, and leaves the rest.
  const CcpBlock motor{.kind = CcpKind::box, .lower = -0.5 * m, .upper = 1.5 * m};
  EXPECT_NEAR(residual(motor, -2.0, 1.5 * m), 0.0, 1e-15);
  EXPECT_NEAR(residual(motor, -1.0, m), 0.0, 1e-15);
  EXPECT_NEAR(residual(motor, 2.0, -0.5 * m), 0.0, 1e-15);
  EXPECT_NEAR(residual(motor, -2.0, 0.0), 1.5, 1e-15);  // P(0 + 2 m) = 1.5 m, over s = m
}

TEST(ccp_figures, violations_and_gap_of_rows) {
  const double m = 0.5;
  const auto figures = [&](const CcpBlock& block, double r, double g) {
    return figures_of(one_block(m, block, {r}), {g});
  };
  // Pulls with 1 N s: u = -1 - 2.
  const CcpFigures pulling = figures({.kind = CcpKind::nonnegative}, -1.0, -1.0);
  EXPECT_EQ(pulling.impulse_violation, 1.0);
  EXPECT_EQ(pulling.velocity_violation, 3.0);
  EXPECT_EQ(pulling.complementarity_gap, 3.0);
  const CcpFigures free = figures({.kind = CcpKind::free}, 5.0, -1.0);
  EXPECT_EQ(free.impulse_violation, 0.0);
  EXPECT_EQ(free.velocity_violation, 3.0);
  // At its lower bound and still moving up: complementary, and no velocity is wrong for a box.
  const CcpFigures held = figures({.kind = CcpKind::box, .lower = -1.0, .upper = kInfinity}, 5.0, -1.0);
  EXPECT_EQ(held.residual, 0.0);
  EXPECT_EQ(held.velocity_violation, 0.0);
  EXPECT_EQ(held.complementarity_gap, 0.0);
  const CcpFigures inside = figures({.kind = CcpKind::box, .lower = -3.0, .upper = 3.0}, 5.0, -1.0);
  EXPECT_EQ(inside.complementarity_gap, 6.0);  // u = 3, two above the lower bound
}

// Slides, spins and rolls at once, with impulses on the bounds of all three against the velocities: exact friction has
// u_n = 0, the associated problem u_n = mu |u_t| + mu_s |u_s| + mu_r |u_rho|.
TEST(ccp_figures, both_laws_of_a_cone_of_six_rows) {
  const double m = 0.7, n = 2.0;
  const CcpBlock block{.kind = CcpKind::cone, .friction = 0.5, .spinning = 0.2, .rolling = 0.1};
  const std::vector<double> gamma{n, -0.3 * n, 0.4 * n, 0.2 * n, -0.06 * n, -0.08 * n};
  const std::vector<double> moving{0.0, 3.0, -4.0, -2.0, 0.6, 0.8};
  const double lift = 0.5 * 5.0 + 0.2 * 2.0 + 0.1 * 1.0;
  std::vector<double> exact = moving, associated = moving;
  associated[0] = lift;
  for (std::size_t k = 0; k < 6; ++k) exact[k] -= gamma[k] / m, associated[k] -= gamma[k] / m;
  const CcpFigures a = figures_of(one_block(m, block, associated), gamma);
  EXPECT_NEAR(a.residual, 0.0, 1e-14);
  EXPECT_NEAR(a.relative_residual, 0.0, 1e-15);
  EXPECT_NEAR(a.velocity_violation, 0.0, 1e-14);
  EXPECT_NEAR(a.complementarity_gap, 0.0, 1e-14);
  EXPECT_LE(a.impulse_violation, 1e-15);
  EXPECT_GT(a.coulomb_residual, 0.1);
  EXPECT_GT(a.coulomb_error, 0.01);
  const CcpFigures c = figures_of(one_block(m, block, exact), gamma);
  EXPECT_NEAR(c.coulomb_residual, 0.0, 1e-14);
  EXPECT_NEAR(c.coulomb_error, 0.0, 1e-15);
  EXPECT_NEAR(c.velocity_violation, lift, 1e-14);
  EXPECT_GT(c.residual, 0.1);
}

// Solutions that were there before r: every figure is the rounding of sums of numbers of size one, and with N written out
// all figures are the same but for the order of sums.
TEST(ccp_figures, vanish_at_planted_solutions_of_every_kind) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const PlantedProblem planted = planted_problem(
        {.bodies = 10, .contacts = 10, .blocks = 20, .compliant = seed % 2 == 0, .repeats = 0.2, .seed = seed});
    const TestingProblem explicit_n = test::with_matrix(planted.problem);
    for (const TestingProblem* const t : {&planted.problem, &explicit_n}) {
      const CcpFigures figures = figures_of(*t, planted.gamma);
      EXPECT_LT(figures.residual, 1e-12) << "seed " << seed;
      EXPECT_LT(figures.relative_residual, 1e-13);
      EXPECT_LT(figures.impulse_violation, 1e-14);
      EXPECT_LT(figures.velocity_violation, 1e-12);
      EXPECT_LT(figures.complementarity_gap, 1e-10);
    }
    std::vector<double> elsewhere = planted.gamma;
    for (std::size_t k = 0; k < elsewhere.size(); k += 5) elsewhere[k] += 0.1;
    const CcpFigures a = figures_of(planted.problem, elsewhere), b = figures_of(explicit_n, elsewhere);
    EXPECT_GT(a.residual, 1e-4);
    EXPECT_NEAR(a.residual, b.residual, 1e-12 * a.residual);
    EXPECT_NEAR(a.objective, b.objective, 1e-11 * std::abs(a.objective));
    EXPECT_NEAR(a.coulomb_error, b.coulomb_error, 1e-12 * a.coulomb_error);
    EXPECT_NEAR(a.complementarity_gap, b.complementarity_gap, 1e-11 * a.complementarity_gap);
  }
}

TEST(ccp_figures, of_blocks_have_the_bits_of_one_thread_for_two) {
  const PlantedProblem planted = planted_problem({.bodies = 2000, .contacts = 3000, .blocks = 5000});
  const Executor two{2};
  const std::vector<double> gamma(planted.gamma.size(), 0.1);
  EXPECT_EQ(ccp_residual(planted.problem.view(), gamma), ccp_residual(planted.problem.view(), gamma, &two));
}

// What no impulse changes has no residual, but its velocities are as wrong as others: two walls that approach each other at
// 1 m/s while they slide at 0.5 m/s, a joint that no body gives way to, and a motor of unlimited strength against it.
TEST(ccp_figures, count_velocities_that_no_impulse_changes) {
  TestingProblem t = sphere_on_floor(0.3, 0.1, 0.5, {0.0, 0.0, 0.0});
  const std::uint32_t wall = t.add_immovable();
  t.add_contact(0, wall, {1, 0, 0}, {}, {}, 0.4, {-1.0, 0.3, 0.4});
  const std::vector<double> none(6, 0.0);
  EXPECT_EQ(figures_of(t, none).residual, 0.0);
  EXPECT_NEAR(figures_of(t, none).velocity_violation, 1.0 + 0.4 * 0.5, 1e-15);
  EXPECT_EQ(figures_of(t, none).complementarity_gap, 0.0);
  // An impulse there, as a guess may have one, meets a velocity: |2 * -1 + 0.25 * 0.3|.
  EXPECT_NEAR(figures_of(t, {0, 0, 0, 2, 0.25, 0}).complementarity_gap, 1.925, 1e-15);

  t.add_block({.kind = CcpKind::free, .a = 0, .b = wall}, test::rows_at_a_point(1, false, {0, 0, 1}, {}, {}, 1.0),
              {3.0});
  EXPECT_EQ(figures_of(t, std::vector<double>(7, 0.0)).residual, 0.0);
  EXPECT_EQ(figures_of(t, std::vector<double>(7, 0.0)).velocity_violation, 3.0);
  const TestingProblem joint = test::with_matrix(t);
  EXPECT_EQ(figures_of(joint, std::vector<double>(7, 0.0)).velocity_violation, 3.0);
}

// A body and its impulses in any unit of mass: the judge speaks of velocities. Squares of 1e-170 kg are zero and those of
// 1e170 kg infinite, so that everything seemed solved, or nothing.
TEST(ccp_residual, is_that_of_a_kilogram_whatever_the_mass) {
  const std::vector<double> u{0.3, -0.5, 0.8, -0.4, 0.2, 0.1};
  const auto residual = [&](double m, CcpBlock block, std::size_t rows, double impulse) {
    block.lower *= m, block.upper *= m;
    std::vector<double> gamma(rows);
    for (std::size_t k = 0; k < rows; ++k) gamma[k] = m * impulse * (k == 0 ? 1.0 : 0.1 * static_cast<double>(k));
    const TestingProblem t = one_block(m, block, {u.begin(), u.begin() + static_cast<std::ptrdiff_t>(rows)});
    return ccp_residual(t.view(), gamma);
  };
  const auto sliding = [](double m, double impulse) {
    return ccp_residual(sphere_on_floor(m, 0.1, 0.5, {0.3, 1.0, -0.4}).view(),
                        std::vector<double>{m * impulse, -0.1 * m * impulse, 0.0});
  };
  const std::pair<CcpBlock, std::size_t> blocks[] = {
      {{.kind = CcpKind::free}, 3},
      {{.kind = CcpKind::nonnegative}, 3},
      {{.kind = CcpKind::box, .lower = -0.25, .upper = 0.125}, 3},
      {{.kind = CcpKind::cone, .friction = 0.5}, 2},
      {{.kind = CcpKind::cone, .friction = 0.5}, 3},
      {{.kind = CcpKind::cone, .friction = 0.5, .spinning = 0.2, .rolling = 0.1}, 6},
  };
  for (const double m : {1e-305, 1e-250, 1e-170, 1e-110, 1e-90, 1e90, 1e110, 1e170, 1e250, 1e305}) {
    for (const double impulse : {0.0, 0.7}) {
      EXPECT_GT(sliding(1.0, impulse), 0.1);
      EXPECT_NEAR(sliding(m, impulse), sliding(1.0, impulse), 1e-14) << m;
      for (const auto& [block, rows] : blocks) {
        EXPECT_NEAR(residual(m, block, rows, impulse), residual(1.0, block, rows, impulse), 1e-14) << m << ", " << rows;
      }
    }
  }
}

// What no impulse changes has no residual, and what is no number has an infinite one.
TEST(ccp_residual, of_immovable_bodies_and_of_numbers_that_are_not_finite) {
  TestingProblem t = one_block(1.0, {.kind = CcpKind::cone, .friction = 0.5}, {-1.0, 0.0, 0.0});
  EXPECT_GT(ccp_residual(t.view(), std::vector<double>(3, 0.0)), 0.5);
  t.blocks[0].b = t.blocks[0].a;
  EXPECT_EQ(ccp_residual(t.view(), std::vector<double>(3, 0.0)), 0.0);
  for (const CcpKind kind : {CcpKind::free, CcpKind::nonnegative, CcpKind::box, CcpKind::cone}) {
    const TestingProblem wrong = one_block(1.0, {.kind = kind}, {1.0, std::nan(""), 0.0});
    EXPECT_EQ(ccp_residual(wrong.view(), std::vector<double>(3, 0.0)), kInfinity);
    const TestingProblem right = one_block(1.0, {.kind = kind}, {1.0, 0.0, 0.0});
    EXPECT_EQ(ccp_residual(right.view(), std::vector<double>{std::nan(""), 0.0, 0.0}), kInfinity);
  }
}

}  // namespace
}  // namespace scree
