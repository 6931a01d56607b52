// The pass of apgd over the contacts, four at a time.
//
// Bodies are seen through the slots of ContactPartition: a run of contacts has velocities and sums of its own, so that runs
// share nothing. Inside a run lane k takes the contacts of its k-th quarter: neighbours in memory rarely share a body then,
// and none has to wait for the sum of the one before.
#pragma once

#include <array>
#include <cstdint>

#include "scree/ccp/lanes.hpp"

namespace scree::apgd {

/// Six numbers of a body or slot: a velocity [m/s, rad/s], or an impulse and its moment [N s, N m s]. One cache line.
struct alignas(64) Motion {
  Lanes linear;   ///< lane 3: nothing
  Lanes angular;  ///< lane 3: nothing
  Motion& operator+=(const Motion& o) {
    linear += o.linear;
    angular += o.angular;
    return *this;
  }
};

/// Four contacts. A lane without a contact has the slot that nobody reads, and no friction.
struct alignas(64) Group {
  Lanes3 normal, tangent1, arm_a, arm_b;  ///< as in CcpContact
  Lanes3 r;                               ///< right-hand side [m/s]
  Lanes m_n, m_t;                         ///< inverse of the metric [kg]
  Lanes friction;                         ///< [1]
  std::array<std::uint32_t, 4> a, b;      ///< slots
};

/// Sums over a pass, lane by lane; see Apgd::Sums.
struct LaneSums {
  Lanes distance{}, uphill{}, linear{}, curvature{}, quadratic{};
};

struct Impulses {
  Lanes3 linear, angular;
};

inline Impulses gather(const Motion* slots, const std::array<std::uint32_t, 4>& index) {
  const Motion &p = slots[index[0]], &q = slots[index[1]], &s = slots[index[2]], &t = slots[index[3]];
  Lanes x = p.linear, y = q.linear, z = s.linear, rest = t.linear;
  Lanes wx = p.angular, wy = q.angular, wz = s.angular, none = t.angular;
  transpose(x, y, z, rest);
  transpose(wx, wy, wz, none);
  return {{x, y, z}, {wx, wy, wz}};
}

/// Adds to four slots, which may be the same.
inline void add(const Lanes3& linear, const Lanes3& angular, const std::array<std::uint32_t, 4>& index, Motion* slots) {
  Lanes l[4] = {linear.x, linear.y, linear.z, Lanes{}};
  Lanes a[4] = {angular.x, angular.y, angular.z, Lanes{}};
  transpose(l[0], l[1], l[2], l[3]);
  transpose(a[0], a[1], a[2], a[3]);
  for (std::size_t k = 0; k < 4; ++k) {
    slots[index[k]].linear += l[k];
    slots[index[k]].angular += a[k];
  }
}

inline Lanes3 hadamard(const Lanes3& a, const Lanes3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// The point of each cone nearest to g in the metric diag(1/m_n, 1/m_t, 1/m_t). project_cone3() with one division.
inline Lanes3 project(const Lanes3& g, const Lanes& m_n, const Lanes& m_t, const Lanes& mu) {
  const Lanes zero{};
  const Lanes t = root(g.y * g.y + g.z * g.z);
  const auto inside = (g.x >= zero) & (t <= mu * g.x);
  const Lanes above = m_t * g.x + mu * m_n * t;  // n = above / (m_t + mu^2 m_n)
  const auto surface = above > zero;
  const Lanes inverse = 1.0 / ((m_t + mu * mu * m_n) * t);
  const Lanes scale = mu * above * inverse;
  // Without a tangential part n is g_n, which is inside, or pulls.
  return {inside ? g.x : (surface ? above * t * inverse : zero), inside ? g.y : (surface ? scale * g.y : zero),
          inside ? g.z : (surface ? scale * g.z : zero)};
}

/// Velocity of each contact that the bodies' `velocity` gives [m/s], r included.
inline Lanes3 contact_velocity(const Group& group, const Lanes3& tangent2, const Motion* velocity) {
  const Impulses a = gather(velocity, group.a), b = gather(velocity, group.b);
  const Lanes3 v = (b.linear + cross(b.angular, group.arm_b)) - (a.linear + cross(a.angular, group.arm_a));
  return Lanes3{dot(group.normal, v), dot(group.tangent1, v), dot(tangent2, v)} + group.r;
}

/// Adds the impulses g of four contacts to the slots of their bodies.
inline void add_impulses(const Group& group, const Lanes3& tangent2, const Lanes3& g, Motion* sums) {
  const Lanes3 p = g.x * group.normal + g.y * group.tangent1 + g.z * tangent2;
  const Lanes3 none{};
  add(none - p, cross(p, group.arm_a), group.a, sums);
  add(p, cross(group.arm_b, p), group.b, sums);
}

/// x_new = P(y - t D^-1 u(y)) of four contacts, added to the slots of their bodies. `compliance` [1/kg] is read for compliant
/// problems only.
template <bool compliant>
inline Lanes3 step(const Group& group, const Lanes3* compliance, const Lanes3& x, const Lanes3& x_old, double beta,
                   double t, const Motion* velocity, Motion* sums, LaneSums& out) {
  const Lanes all_beta = Lanes{} + beta, all_t = Lanes{} + t;
  const Lanes3 tangent2 = cross(group.normal, group.tangent1);
  const Lanes3 y = x + all_beta * (x - x_old);
  Lanes3 u = contact_velocity(group, tangent2, velocity);
  if constexpr (compliant) u = u + hadamard(*compliance, y);
  const Lanes s_n = all_t * group.m_n, s_t = all_t * group.m_t;
  const Lanes3 next =
      project({y.x - s_n * u.x, y.y - s_t * u.y, y.z - s_t * u.z}, group.m_n, group.m_t, group.friction);
  add_impulses(group, tangent2, next, sums);
  const Lanes3 d = next - y;
  const Lanes inverse = 1.0 / (group.m_n * group.m_t);
  const Lanes d_n = group.m_t * inverse, d_t = group.m_n * inverse;
  const Lanes3 scaled{d_n * d.x, d_t * d.y, d_t * d.z};
  out.distance += dot(d, scaled);
  out.uphill -= dot(scaled, next - x);
  out.linear += dot(group.r, next);
  if constexpr (compliant) {
    out.curvature += dot(d, hadamard(*compliance, d));
    out.quadratic += dot(next, hadamard(*compliance, next));
  }
  return next;
}

}  // namespace scree::apgd
