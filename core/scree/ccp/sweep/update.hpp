// Gauss-Seidel updates of contacts, four at a time: the inner loop of every
// sweep. The four share no movable body, so that doing them together is doing
// them one after the other.
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

#include <array>
#include <cstdint>

#include "scree/math/lanes.hpp"

namespace scree::sweep {

/// What a sweep reads and writes of a body: one cache line.
struct alignas(64) Body {
  Lanes linear;   ///< velocity that the impulses cause [m/s]; lane 3: inverse mass [1/kg]
  Lanes angular;  ///< [rad/s]; lane 3: inverse inertia of an isotropic body [1/(kg m2)]
};

/// Columns of an inverse inertia [1/(kg m2)], world; only of bodies that are not
/// isotropic.
struct alignas(32) Inertia {
  Lanes column[3];
};

/// Four contacts. A lane without a contact has zero steps. Its bodies are the one
/// that stands for nothing, as are all immovable bodies: its velocity is zero and
/// stays so, and no other chunk has it.
struct alignas(64) Group {
  Lanes3 normal, tangent1, arm_a, arm_b;  ///< as in CcpContact
  Lanes3 g;                               ///< impulse [N s]
  Lanes3 r;                               ///< right-hand side [m/s]
  Lanes step_n, step_t;                   ///< of LocalStep [kg]
  Lanes along, across, friction;          ///< of the projection [1]
  std::array<std::uint32_t, 4> a, b;      ///< bodies
};

/// The velocities of four bodies, and what their lanes 3 held.
struct Four {
  Lanes3 linear, angular;
  Lanes inverse_mass, inverse_inertia;
};

inline Four gather(const Body* bodies, const std::array<std::uint32_t, 4>& index) {
  const Body &p = bodies[index[0]], &q = bodies[index[1]], &s = bodies[index[2]], &t = bodies[index[3]];
  Lanes x = p.linear, y = q.linear, z = s.linear, m = t.linear;
  Lanes wx = p.angular, wy = q.angular, wz = s.angular, j = t.angular;
  transpose(x, y, z, m);
  transpose(wx, wy, wz, j);
  return {{x, y, z}, {wx, wy, wz}, m, j};
}

inline void scatter(const Four& four, const std::array<std::uint32_t, 4>& index, Body* bodies) {
  Lanes linear[4] = {four.linear.x, four.linear.y, four.linear.z, four.inverse_mass};
  Lanes angular[4] = {four.angular.x, four.angular.y, four.angular.z, four.inverse_inertia};
  transpose(linear[0], linear[1], linear[2], linear[3]);
  transpose(angular[0], angular[1], angular[2], angular[3]);
  for (std::size_t k = 0; k < 4; ++k) bodies[index[k]] = {linear[k], angular[k]};
}

/// I^-1 times the moments of four bodies.
template <bool isotropic>
inline Lanes3 turned(const Four& four, const Inertia* inertias, const std::array<std::uint32_t, 4>& index,
                     const Lanes3& moment) {
  if constexpr (isotropic) return four.inverse_inertia * moment;
  const auto column = [&](int c) {
    Lanes x = inertias[index[0]].column[c], y = inertias[index[1]].column[c], z = inertias[index[2]].column[c];
    Lanes w = inertias[index[3]].column[c];
    transpose(x, y, z, w);
    return Lanes3{x, y, z};
  };
  return moment.x * column(0) + moment.y * column(1) + moment.z * column(2);
}

/// to = from, part by part: as a whole, GCC 12 copies in halves and through memory.
inline void store(Lanes3& to, const Lanes3& from) { to.x = from.x, to.y = from.y, to.z = from.z; }

/// project_cone3() of four impulses.
inline Lanes3 project(const Lanes3& g, const Group& group) {
  const Lanes zero{};
  const Lanes t = root(g.y * g.y + g.z * g.z);
  const auto inside = (g.x >= zero) & (t <= group.friction * g.x);
  const Lanes n = group.along * g.x + group.across * t;
  const auto surface = n > zero;
  const Lanes scale = group.friction * n / t;
  return {inside ? g.x : (surface ? n : zero), inside ? g.y : (surface ? scale * g.y : zero),
          inside ? g.z : (surface ? scale * g.z : zero)};
}

/// Updates the impulses of four contacts and the velocities of their bodies.
/// `compliance` [1/kg] is read for compliant problems only.
template <bool isotropic, bool compliant>
[[gnu::always_inline]] inline void update(Group& group, const Lanes3* compliance, Body* bodies,
                                          const Inertia* inertias) {
  Four a = gather(bodies, group.a), b = gather(bodies, group.b);
  const Lanes3 tangent2 = cross(group.normal, group.tangent1);
  const Lanes3 v = (b.linear + cross(b.angular, group.arm_b)) - (a.linear + cross(a.angular, group.arm_a));
  Lanes3 u = Lanes3{dot(group.normal, v), dot(group.tangent1, v), dot(tangent2, v)} + group.r;
  if constexpr (compliant) {
    u = u + Lanes3{compliance->x * group.g.x, compliance->y * group.g.y, compliance->z * group.g.z};
  }
  const Lanes3 trial{group.g.x - group.step_n * u.x, group.g.y - group.step_t * u.y, group.g.z - group.step_t * u.z};
  const Lanes3 next = project(trial, group);
  const Lanes3 d = next - group.g;
  store(group.g, next);

  const Lanes3 p = d.x * group.normal + d.y * group.tangent1 + d.z * tangent2;
  a.linear = a.linear - a.inverse_mass * p;
  b.linear = b.linear + b.inverse_mass * p;
  a.angular = a.angular - turned<isotropic>(a, inertias, group.a, cross(group.arm_a, p));
  b.angular = b.angular + turned<isotropic>(b, inertias, group.b, cross(group.arm_b, p));
  scatter(a, group.a, bodies);
  scatter(b, group.b, bodies);
}

}  // namespace scree::sweep
