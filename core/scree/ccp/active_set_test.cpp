// Solving by active contacts against solving everything, with a projected Gauss-Seidel of the test's own.
#include "scree/ccp/active_set.hpp"

#include <gtest/gtest.h>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/cone3.hpp"
#include "scree/ccp/judge.hpp"
#include "support/allocation_count.hpp"
#include "support/ccp_planted_problems.hpp"
#include "support/ccp_problems.hpp"

namespace scree {
namespace {

using test::random_problem;
using test::RandomProblem;
using test::TestingProblem;

/// Projected Gauss-Seidel with one step length a contact, half of what its trace bounds: slow and monotone.
class SlowSolver final : public CcpSolver {
 public:
  SolveSummary solve(const CcpProblem& p, const SolveContext& context, std::span<double> gamma) override {
    ++calls;
    blocks = p.contacts.size();
    if (answer != SolveStatus::converged) return {answer, 0, 1.0};
    delassus_.bind(p, nullptr);
    w_.resize(p.bodies());
    delassus_.body_velocities(gamma, w_);
    SolveSummary out{SolveStatus::iteration_limit, 0, ccp_residual(delassus_, gamma, w_, partial_)};
    while (out.residual > context.tolerance && out.iterations < context.max_iterations) {
      for (std::size_t i = 0; i < p.contacts.size(); ++i) update(p, i, gamma);
      for (std::size_t i = 0; i < p.blocks.size(); ++i) update_block(p, i, gamma);
      updates += p.contacts.size();
      delassus_.body_velocities(gamma, w_);
      out.residual = ccp_residual(delassus_, gamma, w_, partial_);
      ++out.iterations;
      if (context.on_iteration) context.on_iteration({out.iterations, out.residual});
    }
    if (out.residual <= context.tolerance) out.status = SolveStatus::converged;
    if (!std::isfinite(out.residual)) out.status = SolveStatus::numerical_failure;
    return out;
  }

  SolveStatus answer = SolveStatus::converged;  ///< anything else is returned at once
  std::size_t updates = 0, calls = 0, blocks = 0;

 private:
  void update(const CcpProblem& p, std::size_t i, std::span<double> gamma) {
    const CcpContact& c = p.contacts[i];
    const Vec3 g = load_block(gamma, i);
    Vec3 u = relative_velocity(c, w_[c.a], w_[c.b]) + load_block(p.r, i);
    if (!p.compliance.empty()) u += hadamard(load_block(p.compliance, i), g);
    // The trace bounds the largest eigenvalue of the block.
    const Vec3 next = project_cone3(g - (1.0 / diagonal_trace(p, i)) * u, c.friction);
    store_block(gamma, i, next);
    Twist a, b;
    add_impulse(c, next - g, a, b);
    w_[c.a] += apply_inverse_mass(p, c.a, a);
    w_[c.b] += apply_inverse_mass(p, c.b, b);
  }

  void update_block(const CcpProblem& p, std::size_t i, std::span<double> gamma) {
    const CcpBlock& block = p.blocks[i];
    const std::span<double> g = rows_of(p, block, gamma);
    BlockVector u, change;
    delassus_.block_velocity(i, w_, gamma, u);
    for (std::size_t k = 0; k < block.rows; ++k) {
      change[k] = -g[k];
      g[k] -= (u[k] + p.r[first_row(p, block) + k]) / diagonal_trace_of_block(p, i);
    }
    project_block(block, g);
    for (std::size_t k = 0; k < block.rows; ++k) change[k] += g[k];
    Twist a, b;
    add_impulse(jacobian_of(p, block), change, a, b);
    w_[block.a] += apply_inverse_mass(p, block.a, a);
    w_[block.b] += apply_inverse_mass(p, block.b, b);
  }

  DelassusOperator delassus_;
  std::vector<Twist> w_;
  std::vector<double> partial_;
};

/// A random feasible problem in which four of five contacts open fast. Opening more keeps it feasible.
TestingProblem open_problem(const RandomProblem& what) {
  TestingProblem t = random_problem(what);
  for (std::size_t i = 0; i < t.contacts.size(); ++i) {
    if (i % 5 != 0) t.r[3 * i] += 6.0;
  }
  return t;
}

SolveContext tight(double tolerance, int max_iterations = 200000) {
  SolveContext context;
  context.tolerance = tolerance;
  context.max_iterations = max_iterations;
  return context;
}

// The velocities of a CCP's solution are unique (its impulses need not be).
std::vector<Twist> velocities(const CcpProblem& p, std::span<const double> gamma) {
  DelassusOperator delassus;
  delassus.bind(p, nullptr);
  std::vector<Twist> w(p.bodies());
  delassus.body_velocities(gamma, w);
  return w;
}

void expect_same_velocities(const CcpProblem& p, std::span<const double> a, std::span<const double> b) {
  const std::vector<Twist> v = velocities(p, a), w = velocities(p, b);
  double largest = 0.0, error = 0.0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    largest = std::max({largest, norm(w[k].linear), norm(w[k].angular)});
    error = std::max({error, norm(v[k].linear - w[k].linear), norm(v[k].angular - w[k].angular)});
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LE(error, 1e-6 * largest);
}

TEST(active_set, velocities_equal_those_of_the_full_solve_from_any_guess) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const TestingProblem t = open_problem({.bodies = 30, .contacts = 80, .compliant = seed % 3 == 0, .seed = seed});
    const CcpProblem p = t.view();
    SlowSolver solver;
    std::vector<double> full(p.rows(), 0.0);
    ASSERT_EQ(solver.solve(p, tight(1e-11), full).status, SolveStatus::converged);

    std::mt19937_64 random{seed};
    std::normal_distribution<double> normal;
    std::vector<double> zero(p.rows(), 0.0), warm = full, wild(p.rows(), 0.0);
    for (double& g : warm) g *= 1.0 + 0.1 * normal(random);
    // Outside the cones, and on few contacts only, so that others stay aside.
    for (std::size_t i = 0; i < p.contacts.size(); i += 10) store_block(wild, i, {normal(random), normal(random), 1.0});
    for (std::size_t i = 1; i < p.contacts.size(); i += 10) store_block(wild, i, {-1.0, 0.5, std::nan("")});
    ActiveSetSolve active_set;
    for (std::vector<double>* gamma : {&zero, &warm, &wild}) {
      const SolveSummary s = active_set.solve(solver, p, tight(1e-11), *gamma);
      EXPECT_EQ(s.status, SolveStatus::converged) << "seed " << seed;
      EXPECT_LT(solver.blocks, p.contacts.size()) << "nothing was put aside";
      EXPECT_EQ(s.residual, ccp_residual(p, *gamma));
      expect_same_velocities(p, *gamma, full);
    }
  }
}

// Blocks are never put aside, whether a contact is active or none. The judge sees the whole problem.
TEST(active_set, blocks_of_every_kind_take_part) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    test::PlantedProblem planted =
        test::planted_problem({.bodies = 40, .contacts = 30, .blocks = 8, .compliant = seed % 3 == 0, .seed = seed});
    TestingProblem& t = planted.problem;
    // Most contacts open faster than they did; in the last problems all.
    for (std::size_t i = 0; i < t.contacts.size(); ++i) {
      if (seed > 10 || i % 5 != 0) t.r[3 * i] += 20.0;
    }
    const CcpProblem p = t.view();
    SlowSolver solver;
    ActiveSetSolve active_set;
    std::vector<double> gamma(p.rows(), 0.0);
    const SolveSummary s = active_set.solve(solver, p, tight(1e-5), gamma);
    EXPECT_EQ(s.status, SolveStatus::converged) << "seed " << seed;
    EXPECT_LT(solver.blocks, p.contacts.size()) << "nothing was put aside";
    EXPECT_EQ(s.residual, ccp_residual(p, gamma));
  }
}

TEST(active_set, problem_without_contacts_goes_to_the_solver) {
  const test::PlantedProblem planted = test::planted_problem({.contacts = 0, .blocks = 8});
  SlowSolver solver;
  ActiveSetSolve active_set;
  std::vector<double> gamma(planted.gamma.size(), 0.0);
  EXPECT_EQ(active_set.solve(solver, planted.problem.view(), tight(1e-9), gamma).status, SolveStatus::converged);
  EXPECT_EQ(solver.calls, 1u);
}

// Equal masses on a line, without friction: the first hits the second, which then closes its gap to the third, opening with
// 0.1 before. Both end without relative velocity: 2 g1 - g2 = 1, 2 g2 - g1 = -0.1.
TEST(active_set, contact_that_the_answer_closes_is_solved_for) {
  TestingProblem t;
  for (int k = 0; k < 10; ++k) t.add_body(1.0, {1, 1, 1});
  t.add_contact(0, 1, {1, 0, 0}, {}, {}, 0.0, {-1.0, 0, 0});
  t.add_contact(1, 2, {1, 0, 0}, {}, {}, 0.0, {0.1, 0, 0});
  for (std::uint32_t k = 3; k < 9; ++k) t.add_contact(k, k + 1, {1, 0, 0}, {}, {}, 0.0, {1.0, 0, 0});
  SlowSolver solver;
  ActiveSetSolve active_set;
  std::vector<double> gamma(t.view().rows(), 0.0);
  const SolveSummary done = active_set.solve(solver, t.view(), tight(1e-13), gamma);
  EXPECT_EQ(done.status, SolveStatus::converged) << done.residual << " after " << done.iterations;
  EXPECT_EQ(solver.blocks, 2u);
  // The residual is a velocity of unit masses; the system's inverse has norm 1.
  EXPECT_NEAR(gamma[0], 1.9 / 3.0, 1e-12);
  EXPECT_NEAR(gamma[3], 0.8 / 3.0, 1e-12);
}

// The gap opens with 0.1, the sphere slides with 1: outside the dual cone for mu > 0.1, where the associated problem has the
// impulse n (1/m + 3.5 mu^2/m) = mu w - v_n of a sphere; below, none.
TEST(active_set, sliding_contact_that_opens_is_aside_only_inside_the_dual_cone) {
  for (const double mu : {0.05, 0.5}) {
    TestingProblem t = test::sphere_on_floor(1.0, 0.1, mu, {0.1, 1.0, 0.0});
    for (int k = 0; k < 9; ++k) t.add_contact(0, t.add_body(1.0, {1, 1, 1}), {0, 0, 1}, {}, {}, mu, {1.0, 0, 0});
    SlowSolver solver;
    ActiveSetSolve active_set;
    std::vector<double> gamma(t.view().rows(), 0.0);
    EXPECT_EQ(active_set.solve(solver, t.view(), tight(1e-13), gamma).status, SolveStatus::converged);
    EXPECT_EQ(solver.calls, mu < 0.1 ? 0u : 1u);
    const double n = std::max(0.0, mu - 0.1) / (1.0 + 3.5 * mu * mu);
    EXPECT_NEAR(gamma[0], n, 1e-12);
    EXPECT_NEAR(gamma[1], -mu * n, 1e-12);
  }
}

TEST(active_set, all_rounds_together_take_the_iterations_asked_for) {
  const TestingProblem t = open_problem({.bodies = 60, .contacts = 900, .mass_decades = 3.0, .seed = 7});
  const CcpProblem p = t.view();
  for (int limit = 0; limit <= 40; ++limit) {
    SlowSolver solver;
    ActiveSetSolve active_set;
    std::vector<double> gamma(p.rows(), 0.0);
    SolveContext context = tight(0.0, limit);
    int last = 0;
    context.on_iteration = [&](const IterationReport& report) {
      EXPECT_GE(report.iteration, last);
      last = report.iteration;
    };
    const SolveSummary s = active_set.solve(solver, p, context, gamma);
    EXPECT_EQ(s.status, SolveStatus::iteration_limit);
    EXPECT_EQ(s.iterations, limit) << "a tolerance of zero uses up all iterations";
    EXPECT_EQ(s.iterations, last);
    // Each iteration updates the contacts of its part only.
    EXPECT_LE(solver.updates, static_cast<std::size_t>(limit) * p.contacts.size());
    EXPECT_EQ(s.residual, ccp_residual(p, gamma));
  }
}

TEST(active_set, objective_is_never_above_that_of_the_projected_guess) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const TestingProblem t = open_problem({.bodies = 40, .contacts = 100, .seed = seed});
    const CcpProblem p = t.view();
    std::vector<double> gamma(p.rows(), 0.0);
    std::mt19937_64 random{seed};
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < p.rows(); i += 7) gamma[i] = normal(random);
    std::vector<double> projected = gamma;
    for (std::size_t i = 0; i < p.contacts.size(); ++i) {
      store_block(projected, i, project_cone3(load_block(gamma, i), p.contacts[i].friction));
    }
    DelassusOperator delassus;
    delassus.bind(p, nullptr);
    SlowSolver solver;
    ActiveSetSolve active_set;
    active_set.solve(solver, p, tight(1e-12, 1 + static_cast<int>(seed)), gamma);
    EXPECT_LE(delassus.objective(gamma), delassus.objective(projected) + 1e-12);
  }
}

TEST(active_set, all_or_no_contacts_active) {
  SlowSolver solver;
  ActiveSetSolve active_set;
  EXPECT_EQ(active_set.solve(solver, CcpProblem{}, tight(1e-9), {}).status, SolveStatus::converged);

  TestingProblem t = open_problem({.bodies = 20, .contacts = 50, .seed = 4});
  for (std::size_t i = 0; i < t.contacts.size(); ++i) t.r[3 * i] = -1.0;
  std::vector<double> gamma(t.view().rows(), 0.0), full = gamma;
  active_set.solve(solver, t.view(), tight(1e-9, 100), gamma);
  solver.solve(t.view(), tight(1e-9, 100), full);
  EXPECT_EQ(gamma, full);

  for (std::size_t i = 0; i < t.contacts.size(); ++i) store_block(t.r, i, {10.0, 0.1, 0.1});
  std::fill(gamma.begin(), gamma.end(), -1.0);  // outside the cones: as good as zero for most
  for (std::size_t i = 0; i < t.contacts.size(); ++i) gamma[3 * i] = -10.0;
  solver.calls = 0;
  const SolveSummary none = active_set.solve(solver, t.view(), tight(1e-9), gamma);
  EXPECT_EQ(none.status, SolveStatus::converged);
  EXPECT_EQ(none.iterations + static_cast<int>(solver.calls), 0);
  EXPECT_EQ(none.residual, 0.0);
  for (const double g : gamma) EXPECT_EQ(g, 0.0);
}

TEST(active_set, ends_as_the_solver_ends) {
  TestingProblem t = open_problem({.bodies = 20, .contacts = 50, .seed = 5});
  for (const SolveStatus status : {SolveStatus::infeasible, SolveStatus::stalled, SolveStatus::numerical_failure}) {
    SlowSolver solver;
    solver.answer = status;
    ActiveSetSolve active_set;
    std::vector<double> gamma(t.view().rows(), 0.0);
    const SolveSummary s = active_set.solve(solver, t.view(), tight(1e-9), gamma);
    EXPECT_EQ(s.status, status);
    EXPECT_EQ(s.residual, ccp_residual(t.view(), gamma));
  }
  // A number that is not finite is never put aside.
  t.r[3 * 7] = std::nan("");
  SlowSolver solver;
  ActiveSetSolve active_set;
  std::vector<double> gamma(t.view().rows(), 0.0);
  EXPECT_EQ(active_set.solve(solver, t.view(), tight(1e-9), gamma).status, SolveStatus::numerical_failure);
}

TEST(active_set, two_threads_give_the_bits_of_one) {
  // Several runs of contacts, so that threads share the work.
  const TestingProblem t = open_problem({.bodies = 3000, .immovable = 3, .contacts = 12000, .seed = 9});
  const Executor two{2};
  SlowSolver solver;
  ActiveSetSolve active_set;
  std::vector<double> a(t.view().rows(), 0.0), b = a;
  SolveContext context = tight(1e-9, 20);
  const SolveSummary one = active_set.solve(solver, t.view(), context, a);
  context.executor = &two;
  EXPECT_EQ(active_set.solve(solver, t.view(), context, b).residual, one.residual);
  EXPECT_EQ(a, b);
}

TEST(active_set, second_solve_of_equal_size_allocates_nothing) {
  const TestingProblem few = open_problem({.bodies = 60, .contacts = 200, .compliant = true, .seed = 1});
  TestingProblem more = open_problem({.bodies = 60, .contacts = 200, .compliant = true, .seed = 2});
  for (std::size_t i = 0; i < 60; ++i) more.r[3 * i] = -0.5;  // more active ones than the first has
  SlowSolver solver;
  ActiveSetSolve active_set;
  const SolveContext context = tight(1e-9, 30);
  std::vector<double> gamma(few.view().rows(), 0.0);
  // The solver has seen as many contacts before; what counts is what the active set asks for.
  solver.solve(more.view(), context, gamma);
  std::fill(gamma.begin(), gamma.end(), 0.0);
  active_set.solve(solver, few.view(), context, gamma);
  const std::size_t before_blocks = solver.blocks;
  std::fill(gamma.begin(), gamma.end(), 0.0);
  const std::uint64_t before = test::allocation_count();
  active_set.solve(solver, more.view(), context, gamma);
  EXPECT_EQ(test::allocation_count() - before, 0U);
  EXPECT_GT(solver.blocks, before_blocks);
  EXPECT_LT(solver.blocks, few.view().contacts.size());
}

}  // namespace
}  // namespace scree
