// What asgs does in single precision: problems of isotropic bodies, which alone begin with it.
#include <cmath>

#include "asgs.hpp"
#include "conformance/ccp_solver_case.hpp"
#include "scree/ccp/judge.hpp"

namespace scree::test {
namespace {

TestingProblem isotropic_problem(std::uint64_t seed, double mass_decades, std::size_t size = 1) {
  TestingProblem t =
      random_problem({.bodies = 60 * size, .contacts = 150 * size, .mass_decades = mass_decades, .seed = seed});
  for (Mat3& j : t.inverse_inertia) j = Mat3::diagonal({j.row0.x, j.row0.x, j.row0.x});
  return t;
}

double speed_of(const TestingProblem& t) {
  double most = 0.0;
  for (const double r : t.r) most = std::max(most, std::abs(r));
  return most;
}

}  // namespace

// A residual above the rounding of single precision is reached with it, far below it by what follows; the judge agrees.
TEST(asgs_single, reaches_what_was_asked_for_on_either_side_of_its_rounding) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TestingProblem t = isotropic_problem(seed, 0.5);
    ASSERT_TRUE(SingleSweep::takes(t.view()));
    for (const double share : {1e-3, 1e-7, 1e-10}) {
      Asgs solver{AsgsOptions{}};
      const double tolerance = share * speed_of(t);
      const Solved s = solve(solver, t.view(), tolerance);
      EXPECT_EQ(s.summary.status, SolveStatus::converged) << "seed " << seed;
      EXPECT_LE(ccp_residual(t.view(), s.gamma), tolerance * (1.0 + 1e-9)) << "seed " << seed;
    }
  }
}

// Impulses of the heaviest, rounded, throw the lightest about: such problems must not be held up by that, nor end above the start.
TEST(asgs_single, mass_ratios_beyond_its_rounding_are_left_to_double_precision) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TestingProblem t = isotropic_problem(seed, 6.0);
    Asgs both{AsgsOptions{}}, double_only{AsgsOptions{.single = false}};
    const Solved a = solve(both, t.view(), 1e-6 * speed_of(t)), b = solve(double_only, t.view(), 1e-6 * speed_of(t));
    EXPECT_EQ(a.summary.status, b.summary.status) << "seed " << seed;
    DelassusOperator delassus;
    const CcpProblem problem = t.view();
    delassus.bind(problem, nullptr);
    EXPECT_LE(delassus.objective(a.gamma), 0.0);
  }
}

// Rounded impulses would lie beside the cones, some outside, by 1e-7 of their size.
TEST(asgs_single, impulses_lie_in_the_cones_to_the_rounding_of_double_precision) {
  const TestingProblem t = isotropic_problem(5, 0.5);
  Asgs solver{AsgsOptions{.relaxed = false}};
  const Solved s = solve(solver, t.view(), 1e-3 * speed_of(t));
  for (std::size_t i = 0; i < t.contacts.size(); ++i) {
    const Vec3 g = load_block(s.gamma, i);
    EXPECT_LE(norm(g - project_cone3(g, t.contacts[i].friction)), 1e-15 * norm(g));
  }
}

// The objective that steers the steps is that of the impulses, with momentum and without; the way back leads to the same bits.
TEST(asgs_single, objective_is_that_of_the_impulses_and_undo_returns_to_those_before) {
  const TestingProblem t = isotropic_problem(7, 0.5);
  const CcpProblem problem = t.view();
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  SingleSweep sweep;
  std::vector<double> gamma(problem.rows(), 0.0), before(gamma);
  sweep.start(problem, gamma, std::vector<Twist>(problem.bodies()), nullptr);
  double last = 0.0;
  for (int pair = 0; pair < 12; ++pair) {
    const double objective = sweep.advance(1.0);
    sweep.impulses(problem, gamma);
    // Sums of a few hundred terms of both signs, each to 6e-8.
    EXPECT_NEAR(objective, delassus.objective(gamma), 1e-5 * std::abs(objective));
    EXPECT_LE(objective, last + 1e-6 * std::abs(objective)) << "pair " << pair;
    last = objective;
    if (pair == 5) sweep.begin_momentum();
    if (pair < 5) (void)sweep.choose();
    if (pair == 10) before = gamma;
  }
  sweep.undo();
  sweep.impulses(problem, gamma);
  EXPECT_EQ(gamma, before);
}

// Whatever the limit, the answer is not above the guess, be it a good or a bad one.
TEST(asgs_single, no_answer_lies_above_the_guess) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TestingProblem t = isotropic_problem(seed, 1.0);
    const CcpProblem problem = t.view();
    DelassusOperator delassus;
    delassus.bind(problem, nullptr);
    Asgs reference{AsgsOptions{.single = false}};
    const Solved solved = solve(reference, problem, 1e-6 * speed_of(t));
    for (const double factor : {0.0, 0.999, 5.0}) {
      for (const int limit : {1, 2, 3, 8, 31}) {
        std::vector<double> gamma = solved.gamma;
        for (double& g : gamma) g *= factor;
        const double before = delassus.objective(gamma);
        Asgs solver{AsgsOptions{}};
        SolveContext context;
        context.tolerance = 1e-7 * speed_of(t);
        context.max_iterations = limit;
        const SolveSummary summary = solver.solve(problem, context, gamma);
        EXPECT_LE(summary.iterations, limit);
        EXPECT_LE(delassus.objective(gamma), before + 1e-12 * std::abs(before));
      }
    }
  }
}

// The callback must count every sweep, whichever precision it has, and watching must change nothing.
TEST(asgs_single, watching_changes_nothing) {
  const TestingProblem t = isotropic_problem(3, 0.5);
  const auto run = [&](bool watched) {
    Asgs solver{AsgsOptions{}};
    std::vector<double> gamma(t.view().rows(), 0.0);
    SolveContext context;
    context.tolerance = 1e-7 * speed_of(t);
    context.max_iterations = 5000;
    int calls = 0;
    if (watched) context.on_iteration = [&](const IterationReport& report) { EXPECT_EQ(report.iteration, ++calls); };
    const SolveSummary summary = solver.solve(t.view(), context, gamma);
    EXPECT_EQ(calls, watched ? summary.iterations : 0);
    return gamma;
  };
  EXPECT_EQ(run(false), run(true));
}

// 15 000 contacts are several chunks of every loop that threads share.
TEST(asgs_single, two_threads_give_the_bits_of_one) {
  const TestingProblem t = isotropic_problem(4, 0.5, 100);
  const Executor two{2};
  Asgs one{AsgsOptions{}}, other{AsgsOptions{}};
  const Solved a = solve(one, t.view(), 1e-4 * speed_of(t), 400),
               b = solve(other, t.view(), 1e-4 * speed_of(t), 400, &two);
  EXPECT_EQ(a.summary.iterations, b.summary.iterations);
  EXPECT_EQ(a.gamma, b.gamma);
}

// Bodies that are not isotropic, compliance and blocks have no single precision.
TEST(asgs_single, takes_contacts_of_isotropic_bodies_only) {
  TestingProblem t = isotropic_problem(1, 0.5);
  EXPECT_TRUE(SingleSweep::takes(t.view()));
  t.compliance.assign(t.r.size(), 1e-3);
  EXPECT_FALSE(SingleSweep::takes(t.view()));
  t.compliance.clear();
  t.inverse_inertia[7].row0.x *= 2.0;
  EXPECT_FALSE(SingleSweep::takes(t.view()));
}

}  // namespace scree::test
