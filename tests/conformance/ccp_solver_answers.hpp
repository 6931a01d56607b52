// What a CcpSolver has to answer for contacts: closed forms and optimality conditions. Part of ccp_solver_conformance.hpp.
#pragma once

#include "conformance/ccp_solver_case.hpp"

namespace scree::test {

TEST_P(CcpSolverConformance, sphere_on_floor_stops_without_friction_left_over) {
  const TestingProblem t = sphere_on_floor(0.3, 0.1, 0.5, {-2.0, 0.0, 0.0});
  const Solved s = solve(*solver_, t.view(), 1e-12);
  EXPECT_EQ(s.summary.status, SolveStatus::converged);
  EXPECT_NEAR(s.gamma[0], 0.6, 1e-12);
  EXPECT_NEAR(s.gamma[1], 0.0, 1e-12);
}

// Slides: the associated problem leaves u in the dual cone's surface, u_n = mu |u_t|, and the impulse on the cone's
// surface, against the velocity. With n and t uncoupled, the KKT conditions give g_n (1/m + 3.5 mu^2/m) = v - mu w.
TEST_P(CcpSolverConformance, sliding_sphere_meets_the_closed_form_of_the_associated_problem) {
  const double m = 0.3, mu = 0.2, v = 1.0, w = 4.0;
  const TestingProblem t = sphere_on_floor(m, 0.1, mu, {-v, w, 0.0});
  const Solved s = solve(*solver_, t.view(), 1e-12);
  const double n = m * (v + mu * w) / (1.0 + 3.5 * mu * mu);
  EXPECT_NEAR(s.gamma[0], n, 1e-11);
  EXPECT_NEAR(s.gamma[1], -mu * n, 1e-11);
  EXPECT_NEAR(s.gamma[2], 0.0, 1e-11);
}

// A cylinder-like sphere in a V of two walls at +-45 degrees: each wall carries W h / sqrt 2 when it is frictionless.
TEST_P(CcpSolverConformance, wedge_without_friction_shares_the_weight) {
  const double m = 2.0, v = 9.81e-3, s = std::sqrt(0.5);
  TestingProblem t;
  const auto left = t.add_immovable(), right = t.add_immovable(), ball = t.add_body(m, {1, 1, 1});
  t.add_contact(left, ball, {s, 0, s}, {}, 0.5 * Vec3{-s, 0, -s}, 0.0, {-v * s, 0, 0});
  t.add_contact(right, ball, {-s, 0, s}, {}, 0.5 * Vec3{s, 0, -s}, 0.0, {-v * s, 0, 0});
  const Solved out = solve(*solver_, t.view(), 1e-12);
  EXPECT_EQ(out.summary.status, SolveStatus::converged);
  EXPECT_NEAR(out.gamma[0], m * v * s, 1e-11);
  EXPECT_NEAR(out.gamma[3], m * v * s, 1e-11);
}

// Without friction and without any tangential velocity: no impulse pulls.
TEST_P(CcpSolverConformance, sphere_that_leaves_the_floor_straight_is_not_held) {
  const Solved s = solve(*solver_, sphere_on_floor(0.3, 0.1, 0.0, {1.0, 0.0, 0.0}).view(), 1e-12);
  EXPECT_EQ(s.summary.status, SolveStatus::converged);
  EXPECT_EQ(s.gamma[0], 0.0);
}

TEST_P(CcpSolverConformance, wedge_with_friction_meets_its_optimality_conditions) {
  const double s = std::sqrt(0.5);
  TestingProblem t;
  const auto left = t.add_immovable(), right = t.add_immovable(), ball = t.add_body(2.0, {0.3, 0.4, 0.5});
  t.add_contact(left, ball, {s, 0, s}, {}, {-0.3, 0.1, -0.4}, 0.4, {-1.0, 0.7, 0.2});
  t.add_contact(right, ball, {-s, 0, s}, {}, {0.3, 0.0, -0.2}, 0.8, {-0.4, -0.5, 0.1});
  const Solved out = solve(*solver_, t.view(), 1e-11);
  EXPECT_EQ(out.summary.status, SolveStatus::converged);
  expect_solution(t.view(), out.gamma, 1e-11);
}

// A column of spheres of masses m, 2 m, ... from the floor up, all falling onto the floor with v: everything stops, and
// contact i passes on the momentum of all that is above it.
TEST_P(CcpSolverConformance, column_passes_the_momentum_above_each_contact) {
  constexpr int kSpheres = 6;
  const double m = 0.2, v = 0.3;
  TestingProblem t;
  std::uint32_t below = t.add_immovable();
  for (int k = 0; k < kSpheres; ++k) {
    const std::uint32_t sphere = t.add_body(m * (k + 1), {1e-3, 1e-3, 1e-3});
    t.add_contact(below, sphere, {0, 0, 1}, k == 0 ? Vec3{} : Vec3{0, 0, 0.1}, {0, 0, -0.1}, 0.4,
                  {k == 0 ? -v : 0.0, 0, 0});
    below = sphere;
  }
  const Solved s = solve(*solver_, t.view(), 1e-10);
  EXPECT_EQ(s.summary.status, SolveStatus::converged);
  for (int i = 0; i < kSpheres; ++i) {
    double above = 0.0;
    for (int k = i; k < kSpheres; ++k) above += m * (k + 1) * v;
    // A velocity error of the tolerance in each of the spheres above, summed up, with room for the chain's conditioning.
    EXPECT_NEAR(s.gamma[static_cast<std::size_t>(3 * i)], above, 1e-7) << "contact " << i;
  }
}

// A table with four legs: how they share the load is not determined, its sum and its moments are.
TEST_P(CcpSolverConformance, four_legs_carry_the_weight_and_no_moment) {
  const double m = 3.0, v = 0.02, a = 0.4, b = 0.25;
  TestingProblem t;
  const auto floor = t.add_immovable(), table = t.add_body(m, {0.2, 0.3, 0.4});
  for (const Vec3& leg : {Vec3{a, b, -0.5}, Vec3{a, -b, -0.5}, Vec3{-a, b, -0.5}, Vec3{-a, -b, -0.5}}) {
    t.add_contact(floor, table, {0, 0, 1}, leg, leg, 0.6, {-v, 0, 0});
  }
  const Solved s = solve(*solver_, t.view(), 1e-11);
  EXPECT_EQ(s.summary.status, SolveStatus::converged);
  expect_solution(t.view(), s.gamma, 1e-11);
  EXPECT_NEAR(s.gamma[0] + s.gamma[3] + s.gamma[6] + s.gamma[9], m * v, 1e-9);
  EXPECT_NEAR(s.gamma[0] + s.gamma[3], s.gamma[6] + s.gamma[9], 1e-9);
  EXPECT_NEAR(s.gamma[0] + s.gamma[6], s.gamma[3] + s.gamma[9], 1e-9);
}

TEST_P(CcpSolverConformance, random_feasible_problems_converge_to_their_optimality_conditions) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TestingProblem t = random_problem({.bodies = 8, .contacts = 14, .compliant = seed % 3 == 0, .seed = seed});
    const Solved s = solve(*solver_, t.view(), 1e-9);
    EXPECT_EQ(s.summary.status, SolveStatus::converged) << "seed " << seed << ", residual " << s.summary.residual;
    expect_solution(t.view(), s.gamma, 1e-9);
  }
}

}  // namespace scree::test
