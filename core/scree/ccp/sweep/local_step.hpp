// The step of one contact in methods that go block by block (Gauss-Seidel,
// Jacobi).
//
// Glossary: A, a symmetric positive semi-definite 3 x 3 block of a contact (rows
// normal, tangent 1, tangent 2); d_n, d_t, the diagonal stiffness that bounds it
// from above, diag(d_n, d_t, d_t) >= A; omega, the relaxation.
//
// A step g <- P(g - omega diag(d)^-1 u), projected in the norm of d, is the
// minimum over the cone of an upper bound of the objective.
#pragma once

#include "scree/ccp/cone3.hpp"
#include "scree/math/mat3.hpp"

namespace scree::sweep {

/// The local step of a contact.
struct LocalStep {
  double normal = 0.0;   ///< omega / d_n [kg]
  double tangent = 0.0;  ///< omega / d_t [kg]
  ConeWeights weights;   ///< of the projection in the norm (d_n, d_t)
};

/// omega / d for block `a` of N [1/kg] with one stiffness for all three rows, or
/// one for the normal and one for the tangents.
[[nodiscard]] LocalStep scalar_step(const Mat3& a, double friction, double omega);
[[nodiscard]] LocalStep block_step(const Mat3& a, double friction, double omega);

}  // namespace scree::sweep
