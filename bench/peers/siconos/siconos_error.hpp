// The error that Siconos itself finds in an answer (Acary et al., Siconos numerics: fc3d_compute_error and
// rolling_fc3d_compute_error): ||r - P(r - u - mu ||u_t|| n)||_2 over a scale. scree's coulomb_error divides by ||q||_2, as
// Siconos' solvers are documented to do; Siconos 4.4 divides by the largest of ||q||_2, ||r||_2 and ||u||_2.
#pragma once

#include <vector>

#include "scree/ccp/fclib/fclib_problem.hpp"

namespace scree {

/// Two figures of one answer.
struct SiconosError {
  double own = 0.0;     ///< as Siconos scales it [1]
  double over_q = 0.0;  ///< the same over ||q||_2 [1]
};

/// Siconos' error of the impulses `r` [N s] for a local problem without bilateral constraints, of 3 rows a contact, or of 5 with
/// rolling friction.
[[nodiscard]] SiconosError siconos_error(const FclibProblem& problem, std::vector<double> r);

}  // namespace scree
