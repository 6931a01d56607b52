// The Gauss-Seidel update of update.hpp for contacts of spheres: those whose arms lie along the normal, of isotropic bodies.
//
// Then N_ii is diag(d_n, d_t, d_t) whatever the tangents: impulses and velocities are kept as world vectors, no tangent is
// needed, and both bodies turn about one axis. A contact takes 120 bytes in place of 192 and half of the arithmetic; sweeps
// over large beds wait for memory, and take that much less.
#pragma once

#include "scree/ccp/sweep/update.hpp"

namespace scree::sweep {

/// Four contacts of spheres. A lane without a contact has zero steps and the body that stands for nothing.
struct alignas(32) SphereGroup {
  Lanes3 normal;                      ///< from a to b [1], world
  Lanes3 g;                           ///< impulse [N s], world
  Lanes3 r;                           ///< right-hand side [m/s], world
  Lanes arm_a, arm_b;                 ///< arms along the normal [m]
  Lanes step_n, step_t, friction;     ///< of LocalStep [kg]; [1]
  std::array<std::uint32_t, 4> a, b;  ///< bodies
};

/// project_cone3() in the norm (1 / step_n, 1 / step_t) of the world impulse `g`.
inline Lanes3 project(const Lanes3& g, const SphereGroup& group) {
  const Lanes zero{};
  const Lanes x = dot(group.normal, g);
  const Lanes3 across = g - x * group.normal;
  const Lanes t = root(dot(across, across));
  const auto inside = (x >= zero) & (t <= group.friction * x);
  const Lanes part = group.friction * group.step_n;
  const Lanes n = (group.step_t * x + part * t) / (group.step_t + group.friction * part);
  const Lanes scale = group.friction * n / t;
  const auto surface = n > zero;
  const auto pick = [&](const Lanes& whole, const Lanes& normal, const Lanes& tangential) {
    return inside ? whole : (surface ? n * normal + scale * tangential : zero);
  };
  return {pick(g.x, group.normal.x, across.x), pick(g.y, group.normal.y, across.y),
          pick(g.z, group.normal.z, across.z)};
}

/// Updates the impulses of four contacts and the velocities of their bodies.
inline void update(SphereGroup& group, Body* bodies) {
  Four a = gather(bodies, group.a), b = gather(bodies, group.b);
  const Lanes3 turning = group.arm_b * b.angular - group.arm_a * a.angular;
  const Lanes3 u = (b.linear - a.linear) + cross(turning, group.normal) + group.r;
  const Lanes excess = (group.step_n - group.step_t) * dot(group.normal, u);
  const Lanes3 next = project(group.g - group.step_t * u - excess * group.normal, group);
  const Lanes3 p = next - group.g;
  group.g = next;

  const Lanes3 moment = cross(group.normal, p);
  a.linear = a.linear - a.inverse_mass * p;
  b.linear = b.linear + b.inverse_mass * p;
  a.angular = a.angular - (a.inverse_inertia * group.arm_a) * moment;
  b.angular = b.angular + (b.inverse_inertia * group.arm_b) * moment;
  scatter(a, group.a, bodies);
  scatter(b, group.b, bodies);
}

}  // namespace scree::sweep
