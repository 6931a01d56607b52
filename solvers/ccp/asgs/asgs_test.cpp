// asgs: the conformance suite of CCP solvers in its orders, and what is its own.
#include "asgs.hpp"

#include <random>

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

/// A problem, and the impulses that its solve begins with [N s].
struct Posed {
  TestingProblem problem;
  std::vector<double> guess;
};

/// A body that is welded to the world, and three stops that it has left: solved by any impulses of the weld with none of the stops, and what
/// these begin with goes to the weld without a change of any velocity, along an objective that falls until they let go.
Posed left_stops(std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  Posed out;
  const std::uint32_t world = out.problem.add_immovable(), body = out.problem.add_body(4.0, {0.6, 0.4, 0.6});
  const Twist motion{vector(), vector()};  // that the weld asks for
  const auto speed = [&](const CcpRow& row) {
    return dot(row.b.linear, motion.linear) + dot(row.b.angular, motion.angular);
  };
  std::vector<CcpRow> weld = rows_at_a_point(6, false, normalized(vector()), 0.3 * vector(), 0.3 * vector(), 1.0);
  std::vector<double> held;
  for (const CcpRow& row : weld) held.push_back(-speed(row));
  for (int k = 0; k < 3; ++k) {
    const CcpRow row = k == 0 ? weld[0] : CcpRow{{}, {normalized(vector()), 0.3 * vector()}};
    out.problem.add_block({.kind = CcpKind::nonnegative, .a = world, .b = body}, {row}, {0.02 - speed(row)});
    out.guess.push_back(std::abs(normal(random)));
  }
  out.problem.add_block({.kind = CcpKind::free, .a = world, .b = body}, weld, held);
  for (std::size_t k = 0; k < weld.size(); ++k) out.guess.push_back(normal(random));
  return out;
}

// The minimum over a plane then lies nowhere: to go far would leave impulses so large that nothing is known of velocities any more.
TEST(asgs, impulses_that_change_no_velocity_are_not_followed_without_end) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Posed stops = left_stops(seed);
    SolveContext context;
    context.tolerance = 1e-10;
    context.max_iterations = 20000;
    Asgs solver{AsgsOptions{}};
    EXPECT_EQ(solver.solve(stops.problem.view(), context, stops.guess).status, SolveStatus::converged) << seed;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(stops.guess[k], 0.0, 1e-9) << seed;
  }
}

/// Bodies that are each held by the same joint twice, with stops along some of its rows between both: N is singular, and what it does not
/// feel goes from the joints to the stops, which can only push. The guess is far from what the bodies' velocities ask for.
Posed held_twice(std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform{0.0, 1.0};
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  Posed out;
  const std::uint32_t world = out.problem.add_immovable();
  for (int k = 0; k < 2; ++k) {
    const double m = std::pow(10.0, 3.0 * uniform(random) - 1.5);
    const auto inertia = [&] { return 0.01 * m * (0.1 + 0.9 * uniform(random)); };
    const std::uint32_t body = out.problem.add_body(m, {inertia(), inertia(), inertia()});
    const std::vector<CcpRow> joint =
        rows_at_a_point(5 + seed % 2, false, {0, 0, 1}, 0.1 * vector(), 0.1 * vector(), 0.3);
    const Twist motion{vector(), vector()};  // that the joint asks for
    std::vector<double> held;
    for (const CcpRow& row : joint)
      held.push_back(-dot(row.b.linear, motion.linear) - dot(row.b.angular, motion.angular));
    std::vector<double> stopped(held.begin(), held.begin() + 4);
    for (double& speed : stopped) speed += std::abs(normal(random));
    out.problem.add_block({.kind = CcpKind::free, .a = world, .b = body}, joint, held);
    out.problem.add_block({.kind = CcpKind::nonnegative, .a = world, .b = body}, {joint.begin(), joint.begin() + 4},
                          stopped);
    out.problem.add_block({.kind = CcpKind::free, .a = world, .b = body}, joint, held);
  }
  for (std::size_t k = 0; k < out.problem.r.size(); ++k) out.guess.push_back(10.0 * normal(random));
  return out;
}

// All stops open in the end, and the joints need masses of 30 kg at most times some m/s. Steps along impulses that N hardly feels left joints
// with up to 1e5 N s that cancel, hiding what is missing: 14 of these solves did not end.
TEST(asgs, steps_that_cones_take_back_leave_no_impulses_that_cancel) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    for (const double tolerance : {1e-6, 1e-10}) {
      Posed held = held_twice(seed);
      SolveContext context;
      context.tolerance = tolerance;
      context.max_iterations = 20000;
      Asgs solver{AsgsOptions{}};
      EXPECT_EQ(solver.solve(held.problem.view(), context, held.guess).status, SolveStatus::converged) << seed;
      for (const double g : held.guess) ASSERT_LT(std::abs(g), 600.0) << seed << ' ' << tolerance;
    }
  }
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
  Asgs alone{AsgsOptions{.conjugate = false, .single = false}},
      together{AsgsOptions{.conjugate = false, .relaxed = false, .single = false}};
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
