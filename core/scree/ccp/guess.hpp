// The first guess of a solve, made fit to start from.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/block_rows.hpp"
#include "scree/ccp/cone3.hpp"
#include "scree/ccp/problem.hpp"
#include "scree/ccp/twist.hpp"

namespace scree {

/// Projects `gamma` (one number a row) [N s] on what each unit may have; units that are not finite start from zero. False
/// when the problem's own r [m/s] is not finite: then nothing can be solved.
inline bool project_guess(const CcpProblem& problem, std::span<double> gamma) {
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Vec3 g = load_block(gamma, i);
    store_block(gamma, i, is_finite(g) ? project_cone3(g, problem.contacts[i].friction) : Vec3{});
  }
  for (const CcpBlock& block : problem.blocks) {
    const std::span<double> g = rows_of(problem, block, gamma);
    if (!std::all_of(g.begin(), g.end(), [](double x) { return std::isfinite(x); })) std::fill(g.begin(), g.end(), 0.0);
    project_block(block, g);
  }
  bool finite = true;
  for (const double value : problem.r) finite = finite && std::isfinite(value);
  return finite;
}

}  // namespace scree
