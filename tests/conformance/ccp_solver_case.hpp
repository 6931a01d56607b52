// What the conformance suite of CCP solvers works with: ways to make a solver, a solve, and the conditions that an
// answer meets.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "scree/ccp/cone3.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/parallel/executor.hpp"
#include "support/ccp_matrix_problem.hpp"
#include "support/ccp_problems.hpp"

namespace scree::test {

/// One way to make a solver.
struct SolverCase {
  std::string name;
  std::function<std::unique_ptr<CcpSolver>()> make;
};

inline std::ostream& operator<<(std::ostream& out, const SolverCase& solver) { return out << solver.name; }

inline std::string solver_case_name(const testing::TestParamInfo<SolverCase>& info) { return info.param.name; }

/// Solves to `tolerance` [m/s] from a zero guess.
struct Solved {
  std::vector<double> gamma;
  SolveSummary summary;
};
inline Solved solve(CcpSolver& solver, const CcpProblem& problem, double tolerance, int max_iterations = 200000,
                    const Executor* executor = nullptr) {
  Solved out{std::vector<double>(problem.rows(), 0.0), {}};
  SolveContext context;
  context.tolerance = tolerance;
  context.max_iterations = max_iterations;
  context.executor = executor;
  out.summary = solver.solve(problem, context, out.gamma);
  return out;
}

/// Whether the solver takes blocks and matrices, which it is asked for with a joint on one body: one that cannot throws
/// std::logic_error.
inline bool takes_blocks(CcpSolver& solver) {
  const TestingProblem joint = one_block(1.0, {}, {1.0, -2.0});
  try {
    for (const TestingProblem& t : {joint, with_matrix(joint)}) (void)solve(solver, t.view(), 1e-9, 1000);
  } catch (const std::logic_error&) {
    return false;
  }
  return true;
}

inline double objective_of(const CcpProblem& problem, std::span<const double> gamma) {
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  return delassus.objective(gamma);
}

/// The objective after any number of iterations is not above that of `guess`, projected on the cones.
inline void expect_never_above(CcpSolver& solver, const CcpProblem& p, const std::vector<double>& guess,
                               const std::string& what) {
  std::vector<double> projected = guess;
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    store_block(projected, i, project_cone3(load_block(guess, i), p.contacts[i].friction));
  }
  for (const CcpBlock& block : p.blocks) project_block(block, rows_of(p, block, std::span{projected}));
  const double start = objective_of(p, projected);
  for (const int limit : {1, 2, 3, 10}) {
    std::vector<double> gamma = guess;
    SolveContext context;
    context.tolerance = 0.0;
    context.max_iterations = limit;
    solver.solve(p, context, gamma);
    EXPECT_LE(objective_of(p, gamma), start + 1e-12 * std::abs(start)) << what << ", limit " << limit;
  }
}

class CcpSolverConformance : public testing::TestWithParam<SolverCase> {
 protected:
  std::unique_ptr<CcpSolver> solver_ = GetParam().make();
};

// gamma in K, u = N gamma + r in K*, gamma . u = 0, straight from the definitions (KKT).
inline void expect_solution(const CcpProblem& p, const std::vector<double>& gamma, double tolerance) {
  DelassusOperator delassus;
  delassus.bind(p, nullptr);
  std::vector<double> u(p.rows());
  delassus.apply(gamma, u);
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    const double mu = p.contacts[i].friction;
    const Vec3 g = load_block(gamma, i), v = load_block(u, i) + load_block(p.r, i);
    const double scale = 3.0 / diagonal_trace(p, i);
    EXPECT_GE(mu * g.x - std::hypot(g.y, g.z), -1e-13 * norm(g)) << "impulse " << i << " outside its cone";
    // The residual bounds the distance of u from K* and, times the impulse or the velocity, the complementarity gap.
    EXPECT_GE(v.x - mu * std::hypot(v.y, v.z), -4.0 * tolerance * (1.0 + mu)) << "velocity " << i;
    EXPECT_NEAR(dot(g, v), 0.0, 4.0 * tolerance * (norm(g) + scale * norm(v))) << "complementarity " << i;
  }
}

}  // namespace scree::test
