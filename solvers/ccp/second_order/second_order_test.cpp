// The second-order solvers: the conformance suite in variants, problems that first-order methods fail on, and the algebra
// of their cones.
#include <gtest/gtest.h>

#include "conformance/ccp_solver_conformance.hpp"
#include "interior_point.hpp"
#include "second_order_cone.hpp"
#include "semismooth_newton.hpp"
#include "small_root.hpp"

namespace scree::test {
namespace {

using second_order::PenaltyOptions;
using second_order::Scaling;
using second_order::SmallRoot;

INSTANTIATE_TEST_SUITE_P(
    second_order, CcpSolverConformance,
    testing::Values(
        SolverCase{"short_steps",
                   [] { return std::make_unique<InteriorPoint>(InteriorPointOptions{.step_fraction = 0.9}); }},
        SolverCase{"soft_newton",
                   [] { return std::make_unique<SemismoothNewton>(PenaltyOptions{.first = 1.0, .growth = 3.0}); }}),
    solver_case_name);

Vec3 inside(std::mt19937_64& random, double margin) {
  std::normal_distribution<double> normal;
  const double y = normal(random), z = normal(random);
  return {std::hypot(y, z) * (1.0 + margin), y, z};
}

// W z = W^-1 s, the property that defines the scaling, also where both points are near opposite sides of the boundary.
TEST(second_order_cone, scaling_takes_both_points_to_one) {
  std::mt19937_64 random{4};
  for (const double margin : {1.0, 1e-3, 1e-6}) {
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3 s = inside(random, margin), z = inside(random, 1.0);
      const Scaling w(s, z);
      const Vec3 a = w.times(z), b = w.over(s);
      // Points known to 1e-16 have a distance from the boundary known to 1e-16 / margin.
      EXPECT_LE(norm(a - b), 1e-13 / margin * norm(a));
      EXPECT_LE(norm(w.over(w.times(s)) - s), 1e-13 / margin * norm(s));
    }
  }
}

TEST(second_order_cone, quotient_undoes_the_product) {
  std::mt19937_64 random{5};
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 l = inside(random, 0.1), x = inside(random, 0.5) - inside(random, 0.5);
    EXPECT_LE(norm(second_order::jordan_quotient(l, second_order::jordan_product(l, x)) - x), 1e-12 * norm(x));
  }
}

// The step ends on the boundary, or is the most that was asked for and ends inside.
TEST(second_order_cone, step_goes_to_the_boundary_and_not_beyond) {
  std::mt19937_64 random{6};
  int stopped = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 x = inside(random, 0.3), d = inside(random, 0.5) - 2.0 * inside(random, 0.5);
    const double step = second_order::step_to_boundary(x, d, 1.0);
    const Vec3 end = x + step * d;
    EXPECT_GE(end.x - std::hypot(end.y, end.z), -1e-13 * norm(x + d));
    if (step == 1.0) continue;
    ++stopped;
    EXPECT_NEAR(end.x, std::hypot(end.y, end.z), 1e-12 * (norm(x) + norm(d)));
  }
  EXPECT_GT(stopped, 50);
}

// R^T R = sum x x^T, and the inverse of R is its inverse.
TEST(small_root, is_a_root_of_the_sum_of_squares) {
  std::mt19937_64 random{7};
  std::normal_distribution<double> normal;
  constexpr std::size_t kRows = 4;
  SmallRoot root(kRows);
  std::array<std::array<double, kRows>, kRows> sum{};
  for (int row = 0; row < 7; ++row) {
    SmallRoot::Row x{};
    for (std::size_t k = 0; k < kRows; ++k) x[k] = normal(random);
    for (std::size_t i = 0; i < kRows; ++i) {
      for (std::size_t j = 0; j < kRows; ++j) sum[i][j] += x[i] * x[j];
    }
    root.add(x);
  }
  std::array<double, kRows * kRows> r{}, inverse{};
  root.store(r);
  root.store_inverse(inverse);
  for (std::size_t i = 0; i < kRows; ++i) {
    for (std::size_t j = 0; j < kRows; ++j) {
      double square = 0.0, unit = 0.0;
      for (std::size_t k = 0; k < kRows; ++k) {
        square += r[i * kRows + k] * r[j * kRows + k];
        unit += r[k * kRows + i] * inverse[j * kRows + k];
      }
      EXPECT_NEAR(square, sum[i][j], 1e-13 * sum[i][i] + 1e-13 * sum[j][j]);
      EXPECT_NEAR(unit, i == j ? 1.0 : 0.0, 1e-12);
    }
  }
}

/// A pile of spheres on a grid, each on four below it: very many more contacts than it takes to hold it.
TestingProblem pile(int layers, double mass_ratio) {
  TestingProblem t;
  const std::uint32_t floor = t.add_immovable();
  const double radius = 0.05, weight = 9.81e-3;
  std::vector<std::vector<std::uint32_t>> below;
  for (int layer = 0; layer < layers; ++layer) {
    const int side = layers - layer;
    std::vector<std::vector<std::uint32_t>> now(static_cast<std::size_t>(side));
    const double m = layer % 2 == 0 ? 1.0 : mass_ratio, j = 0.4 * m * radius * radius;
    for (std::size_t x = 0; x < now.size(); ++x) {
      for (std::size_t y = 0; y < now.size(); ++y) {
        now[x].push_back(t.add_body(m, {j, j, j}));
        const std::uint32_t ball = now[x].back();
        if (layer == 0) t.add_contact(floor, ball, {0, 0, 1}, {}, {0, 0, -radius}, 0.5, {-weight, 0, 0});
        for (std::size_t k = 0; layer > 0 && k < 4; ++k) {
          const std::size_t dx = k / 2, dy = k % 2;
          const Vec3 n = normalized(Vec3{dx == 0 ? 1.0 : -1.0, dy == 0 ? 1.0 : -1.0, std::sqrt(2.0)});
          t.add_contact(below[x + dx][y + dy], ball, n, radius * n, -radius * n, 0.5, {});
        }
      }
    }
    below = now;
  }
  return t;
}

// Many more contacts than hold the pile, and masses four decades apart: sweeps over contacts need very many here.
TEST(second_order, pile_with_heavy_layers_is_solved_to_the_last_digits) {
  for (const double ratio : {1.0, 1e4}) {
    const TestingProblem t = pile(6, ratio);
    InteriorPoint interior{InteriorPointOptions{}};
    const Solved s = solve(interior, t.view(), 1e-10, 200);
    EXPECT_EQ(s.summary.status, SolveStatus::converged) << "ratio " << ratio << ", residual " << s.summary.residual;
    EXPECT_LE(s.summary.iterations, 80);
    expect_solution(t.view(), s.gamma, 1e-10);
  }
}

// From an answer, slightly disturbed, few steps are needed: the method makes use of a guess.
TEST(second_order, newton_steps_make_use_of_a_guess) {
  const TestingProblem t = random_problem({.bodies = 100, .contacts = 250, .reach = 8, .seed = 11});
  SemismoothNewton newton{PenaltyOptions{}};
  Solved cold = solve(newton, t.view(), 1e-9, 500);
  ASSERT_EQ(cold.summary.status, SolveStatus::converged);
  for (double& g : cold.gamma) g *= 1.0 + 1e-6;
  SolveContext context;
  context.tolerance = 1e-9;
  context.max_iterations = 500;
  const SolveSummary warm = newton.solve(t.view(), context, cold.gamma);
  EXPECT_EQ(warm.status, SolveStatus::converged);
  EXPECT_LE(2 * warm.iterations, cold.summary.iterations);
}

// Three times the answer is above no impulses at all (of an answer g, the objective of t g is (t - t^2 / 2) r.g, with r.g < 0): then the
// way from zero is taken, step by step, whatever the guess.
TEST(second_order, newton_steps_begin_at_zero_when_the_guess_is_above_it) {
  const TestingProblem t = random_problem({.bodies = 40, .contacts = 100, .reach = 8, .seed = 12});
  SemismoothNewton newton{PenaltyOptions{}};
  const Solved cold = solve(newton, t.view(), 1e-9, 500);
  ASSERT_EQ(cold.summary.status, SolveStatus::converged);
  std::vector<double> far = cold.gamma;
  for (double& g : far) g *= 3.0;
  ASSERT_GT(objective_of(t.view(), far), 0.0);
  SolveContext context;
  context.tolerance = 1e-9;
  context.max_iterations = 500;
  const SolveSummary summary = newton.solve(t.view(), context, far);
  EXPECT_EQ(summary.status, SolveStatus::converged);
  EXPECT_EQ(summary.iterations, cold.summary.iterations);
  EXPECT_EQ(far, cold.gamma);
}

/// Two bodies, one upon the other, on a floor, and below a ceiling that comes down, unless it is `open` above.
TestingProblem squeezed(bool open) {
  TestingProblem t;
  const std::uint32_t below = t.add_immovable(), above = t.add_immovable();
  const std::uint32_t body = t.add_body(2.0, {0.1, 0.1, 0.1}), other = t.add_body(1.0, {0.1, 0.1, 0.1});
  t.add_contact(below, body, {0, 0, 1}, {}, {0, 0, -0.1}, 0.5, {-1.0, 0.3, 0.0});
  t.add_contact(body, other, {0, 0, 1}, {0, 0, 0.1}, {0, 0, -0.1}, 0.3, {-0.5, 0.0, 0.1});
  if (!open) {
    t.add_block({.kind = CcpKind::nonnegative, .a = above, .b = other}, {{{}, {{0, 0, -1}, {}}}}, {-1.0});
  }
  return t;
}

// Floor and ceiling come together, and no impulse of what is between them holds them apart.
TEST(second_order, bodies_squeezed_between_walls_have_no_solution) {
  InteriorPoint interior{InteriorPointOptions{}};
  SemismoothNewton newton{PenaltyOptions{}};
  for (CcpSolver* const solver : std::initializer_list<CcpSolver*>{&interior, &newton}) {
    const Solved s = solve(*solver, squeezed(false).view(), 1e-9, 1000);
    EXPECT_EQ(s.summary.status, SolveStatus::infeasible) << s.summary.iterations << ", residual " << s.summary.residual;
    EXPECT_EQ(solve(*solver, squeezed(true).view(), 1e-9, 1000).summary.status, SolveStatus::converged);
  }
}

// Two contacts in one place, and two joints: which of them carries the load is not determined, that they do is.
TEST(second_order, repeated_units_of_every_kind_are_solved) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PlantedProblem planted =
        planted_problem({.compliant = seed % 4 == 0, .mass_decades = 4.0, .repeats = 0.5, .seed = seed});
    InteriorPoint interior{InteriorPointOptions{}};
    const Solved s = solve(interior, planted.problem.view(), 1e-9, 300);
    EXPECT_EQ(s.summary.status, SolveStatus::converged) << "seed " << seed << ", residual " << s.summary.residual;
  }
}

}  // namespace
}  // namespace scree::test
