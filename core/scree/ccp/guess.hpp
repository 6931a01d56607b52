// The first guess of a solve, made fit to start from.
#pragma once

#include <cmath>
#include <span>

#include "scree/ccp/cone3.hpp"
#include "scree/ccp/problem.hpp"
#include "scree/ccp/twist.hpp"

namespace scree {

/// Projects `gamma` (3 m) [N s] on the cones; blocks that are not finite become zero. False when the problem's own r [m/s]
/// is not finite: then nothing can be solved.
inline bool project_guess(const CcpProblem& problem, std::span<double> gamma) {
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Vec3 g = load_block(gamma, i);
    store_block(gamma, i, is_finite(g) ? project_cone3(g, problem.contacts[i].friction) : Vec3{});
  }
  bool finite = true;
  for (const double value : problem.r) finite = finite && std::isfinite(value);
  return finite;
}

}  // namespace scree
