// One Gauss-Seidel update of a contact: the inner loop of pgs.
//
// Glossary: A = N_ii, the 3 x 3 block of a contact; d_n, d_t, the diagonal
// stiffness that bounds it from above, diag(d_n, d_t, d_t) >= A; u, the contact
// velocity at this moment of the sweep; omega, the relaxation.
//
// The update minimises the objective's upper bound
//     u . (x - g) + 1/(2 omega) (x - g)^T diag(d_n, d_t, d_t) (x - g)
// over the cone, in closed form, so that no update ever raises the objective
// (for omega < 2). For spheres A is diagonal and the update is the exact
// minimum over the contact.
#pragma once

#include "scree/ccp/cone3.hpp"
#include "scree/ccp/twist.hpp"

namespace scree::pgs {

/// All that a sweep needs of a body: two cache lines.
struct alignas(64) Body {
  Twist velocity;             ///< caused by the impulses [m/s, rad/s], world
  double inverse_mass = 0.0;  ///< [1/kg]
  Mat3 inverse_inertia;       ///< [1/(kg m2)], world
};

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

/// Updates the impulse `g` [N s] of contact c and the velocities of its bodies.
/// `r` [m/s], `compliance` [1/kg].
template <bool compliant>
inline void update(const CcpContact& c, const LocalStep& step, const Vec3& r, const Vec3& compliance, Body& a, Body& b,
                   Vec3& g) {
  Vec3 u = relative_velocity(c, a.velocity, b.velocity) + r;
  if constexpr (compliant) u += hadamard(compliance, g);
  const Vec3 trial{g.x - step.normal * u.x, g.y - step.tangent * u.y, g.z - step.tangent * u.z};
  const Vec3 next = project_cone3(trial, c.friction, step.weights);
  const Vec3 p = in_world(c, next - g);
  g = next;
  // An immovable body may be shared between threads: it is never written.
  if (a.inverse_mass > 0.0) {
    a.velocity.linear -= a.inverse_mass * p;
    a.velocity.angular -= a.inverse_inertia * cross(c.arm_a, p);
  }
  if (b.inverse_mass > 0.0) {
    b.velocity.linear += b.inverse_mass * p;
    b.velocity.angular += b.inverse_inertia * cross(c.arm_b, p);
  }
}

}  // namespace scree::pgs
