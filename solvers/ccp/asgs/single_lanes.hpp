// Eight contacts side by side in single precision: the inner loop of SingleSweep.
//
// The same update as that of sweep/update.hpp, for isotropic bodies and no compliance, in half the bytes and twice the lanes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace scree::single {

using Lanes = float __attribute__((vector_size(32)));

struct Lanes3 {
  Lanes x, y, z;
};

inline Lanes3 operator+(const Lanes3& a, const Lanes3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Lanes3 operator*(const Lanes& s, const Lanes3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Lanes dot(const Lanes3& a, const Lanes3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes root(const Lanes& a) {
  Lanes out;
  for (int k = 0; k < 8; ++k) out[k] = std::sqrt(a[k]);
  return out;
}

/// Velocity that the impulses cause [m/s], inverse mass [1/kg], angular velocity [rad/s], inverse inertia [1/(kg m2)].
using Body = Lanes;
using Bodies8 = std::array<std::uint32_t, 8>;

/// Eight contacts; otherwise as sweep::Group.
struct alignas(64) Group {
  Lanes3 normal, tangent1, arm_a, arm_b;  ///< as in CcpContact
  Lanes3 g;                               ///< impulse [N s]
  Lanes3 r;                               ///< right-hand side [m/s]
  Lanes step_n, step_t;                   ///< of LocalStep [kg]
  Lanes along, across, friction;          ///< of the projection [1]
  Bodies8 a, b;                           ///< bodies
};

/// Rows become columns.
inline void transpose(std::array<Lanes, 8>& m) {
  std::array<Lanes, 8> p, q;
  for (std::size_t k = 0; k < 8; k += 2) {
    p[k] = __builtin_shufflevector(m[k], m[k + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    p[k + 1] = __builtin_shufflevector(m[k], m[k + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (std::size_t k = 0; k < 8; k += 4) {
    for (std::size_t i = 0; i < 2; ++i) {
      q[k + 2 * i] = __builtin_shufflevector(p[k + i], p[k + 2 + i], 0, 1, 8, 9, 4, 5, 12, 13);
      q[k + 2 * i + 1] = __builtin_shufflevector(p[k + i], p[k + 2 + i], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    m[k] = __builtin_shufflevector(q[k], q[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    m[k + 4] = __builtin_shufflevector(q[k], q[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// Eight bodies: linear x, y, z, inverse masses, angular x, y, z, inverse inertias.
using Eight = std::array<Lanes, 8>;

inline Eight gather(const Body* bodies, const Bodies8& index) {
  Eight out;
  for (std::size_t k = 0; k < 8; ++k) out[k] = bodies[index[k]];
  transpose(out);
  return out;
}

inline void scatter(Eight eight, const Bodies8& index, Body* bodies) {
  transpose(eight);
  for (std::size_t k = 0; k < 8; ++k) bodies[index[k]] = eight[k];
}

inline Lanes3 velocity_at(const Eight& body, const Lanes3& arm) {
  return Lanes3{body[0], body[1], body[2]} + cross({body[4], body[5], body[6]}, arm);
}

/// Adds impulse p at `arm`.
inline void push(Eight& body, const Lanes3& arm, const Lanes3& p) {
  const Lanes3 moment = cross(arm, p);
  body[0] += body[3] * p.x, body[1] += body[3] * p.y, body[2] += body[3] * p.z;
  body[4] += body[7] * moment.x, body[5] += body[7] * moment.y, body[6] += body[7] * moment.z;
}

/// project_cone3() of eight impulses.
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

/// Updates impulses that are `from`, and the velocities of their bodies; keeps the new ones in the group.
[[gnu::always_inline]] inline void update(Group& group, const Lanes3& from, Body* bodies) {
  Eight a = gather(bodies, group.a), b = gather(bodies, group.b);
  const Lanes3 tangent2 = cross(group.normal, group.tangent1);
  const Lanes3 v = velocity_at(b, group.arm_b) - velocity_at(a, group.arm_a);
  const Lanes3 u = Lanes3{dot(group.normal, v), dot(group.tangent1, v), dot(tangent2, v)} + group.r;
  const Lanes3 next =
      project({from.x - group.step_n * u.x, from.y - group.step_t * u.y, from.z - group.step_t * u.z}, group);
  const Lanes3 d = next - from;
  group.g.x = next.x, group.g.y = next.y, group.g.z = next.z;
  const Lanes3 p = d.x * group.normal + d.y * group.tangent1 + d.z * tangent2;
  push(a, group.arm_a, {-p.x, -p.y, -p.z});
  push(b, group.arm_b, p);
  scatter(a, group.a, bodies);
  scatter(b, group.b, bodies);
}

using Count = std::int32_t __attribute__((vector_size(32)));

/// -1 in the lanes whose impulse went from `from` to where it is because of a velocity above `speed`.
inline Count exceeds(const Group& group, const Lanes3& from, const Lanes& speed) {
  const Lanes3 d = group.g - from;
  const Lanes n = speed * group.step_n, t = speed * group.step_t;
  return (d.x * d.x > n * n) | (d.y * d.y + d.z * d.z > t * t);
}

/// x^T d y, d the metric of the steps; lanes without a contact have none.
inline Lanes metric_product(const Group& group, const Lanes3& x, const Lanes3& y) {
  const Lanes zero{};
  const Lanes product = x.x * y.x / group.step_n + (x.y * y.y + x.z * y.z) / group.step_t;
  return group.step_n > zero ? product : zero;
}

[[gnu::always_inline]] inline void prefetch(const Group& group, const Body* bodies) {
  for (const Bodies8* index : {&group.a, &group.b}) {
    for (const std::uint32_t body : *index) __builtin_prefetch(bodies + body, 1);
  }
}

}  // namespace scree::single
