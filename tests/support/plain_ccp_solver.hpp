// A solver of CCPs for tests of what stands over a solver: short, from the definition, slow.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/interfaces/ccp_solver.hpp"

namespace scree::test {

/// Projects every contact and block of `gamma`.
inline void project_all(const CcpProblem& problem, std::span<double> gamma) {
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    project_block(block_of(problem.contacts[i]), gamma.subspan(3 * i, 3));
  }
  for (const CcpBlock& block : problem.blocks) {
    project_block(block, gamma.subspan(problem.contact_rows() + block.first_row, block.rows));
  }
}

/// Nesterov's projected gradient with restart; N is symmetric.
inline SolveSummary solve_plainly(const CcpProblem& problem, double tolerance, int max_iterations,
                                  std::span<double> gamma) {
  DelassusOperator delassus;
  delassus.bind(problem, nullptr);
  const std::size_t rows = problem.rows();
  std::vector<double> y(rows, 1.0), u(rows), next(rows);
  double lipschitz = 0.0;
  for (int k = 0; k < 60; ++k) {  // power iteration
    delassus.apply(y, u);
    lipschitz = 0.0;
    for (const double x : u) lipschitz += x * x;
    lipschitz = std::sqrt(lipschitz);
    for (std::size_t i = 0; i < rows; ++i) y[i] = lipschitz > 0.0 ? u[i] / lipschitz : 0.0;
  }
  const double step = lipschitz > 0.0 ? 0.9 / lipschitz : 0.0;
  project_all(problem, gamma);
  y.assign(gamma.begin(), gamma.end());
  double theta = 1.0;
  SolveSummary summary{SolveStatus::iteration_limit, 0, ccp_residual(problem, gamma)};
  while (summary.residual > tolerance && summary.iterations < max_iterations) {
    delassus.apply(y, u);
    for (std::size_t i = 0; i < rows; ++i) next[i] = y[i] - step * (u[i] + problem.r[i]);
    project_all(problem, next);
    double uphill = 0.0;
    for (std::size_t i = 0; i < rows; ++i) uphill += (y[i] - next[i]) * (next[i] - gamma[i]);
    const double then = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * theta * theta));
    const double carry = uphill > 0.0 ? 0.0 : (theta - 1.0) / then;
    theta = uphill > 0.0 ? 1.0 : then;
    for (std::size_t i = 0; i < rows; ++i) {
      y[i] = next[i] + carry * (next[i] - gamma[i]);
      gamma[i] = next[i];
    }
    ++summary.iterations;
    if (summary.iterations % 5 == 0) summary.residual = ccp_residual(problem, gamma);
  }
  summary.residual = ccp_residual(problem, gamma);
  if (summary.residual <= tolerance) summary.status = SolveStatus::converged;
  return summary;
}

}  // namespace scree::test
