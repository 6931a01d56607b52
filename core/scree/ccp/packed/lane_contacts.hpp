// Four contacts at a time, in the fewest bytes: what the passes of gradient methods over all contacts are made of.
//
// Glossary: p, the impulse of a contact as a vector of the world [N s]: n, the normal, and the part across it are all that
// a cone asks for, so that tangents are not needed, neither stored nor computed; u = v_b - v_a + r, the velocity of a
// contact, in the world as well [m/s]; D = diag(1/m_n, 1/m_t, 1/m_t), the metric of a contact.
#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <limits>

#include "scree/ccp/packed/lane_slots.hpp"

namespace scree::packed {

/// Groups that a pass asks for in advance.
inline constexpr std::size_t kAhead = 8;

using Floats = float __attribute__((vector_size(16)));

/// Four contacts: 120 bytes each. A lane without a contact is all zero but for m_n and m_t, which are 1, and its slots,
/// which nobody reads.
struct alignas(32) Group {
  Lanes3 normal, arm_a, arm_b;  ///< as in CcpContact
  Lanes3 r;                     ///< right-hand side, in the world [m/s]
  Lanes friction;               ///< [1]
  Floats m_n, m_t;              ///< inverse of the metric [kg]: any will do, so rounded ones too
  Offsets a, b;                 ///< slots
};

/// E of four contacts, which needs the tangents: tangent 2 is normal x tangent 1.
struct alignas(32) GroupCompliance {
  Lanes3 tangent1;
  Lanes3 e;  ///< along normal, tangent 1 and 2 [1/kg]
};

/// The metric of four contacts, unpacked.
struct Metric {
  Lanes m_n, m_t;  ///< [kg]
  Lanes d_n, d_t;  ///< their inverses [1/kg]
};

inline Lanes all(double value) { return Lanes{} + value; }
inline double total(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }
inline double greatest(const Lanes& a) {
  const double low = a[0] > a[1] ? a[0] : a[1], high = a[2] > a[3] ? a[2] : a[3];
  return low > high ? low : high;
}

inline Lanes widen(const Floats& a) {
#ifdef __AVX__
  return _mm256_cvtps_pd(a);  // what is meant below, which compilers do in halves and through memory
#else
  return __builtin_convertvector(a, Lanes);
#endif
}

inline Metric metric_of(const Group& group) {
  const Floats one{1.0F, 1.0F, 1.0F, 1.0F};
  return {widen(group.m_n), widen(group.m_t), widen(one / group.m_n), widen(one / group.m_t)};
}

/// v_b - v_a, for the velocities of the slots.
inline Lanes3 relative_velocity(const Group& group, const Slot* slots) {
  const Twists a = gather(slots, group.a), b = gather(slots, group.b);
  return (b.linear + cross(b.angular, group.arm_b)) - (a.linear + cross(a.angular, group.arm_a));
}

/// u, for the velocities of the slots.
inline Lanes3 contact_velocity(const Group& group, const Slot* slots) {
  return relative_velocity(group, slots) + group.r;
}

/// Asks for the slots of a group that a pass comes to soon: there are too many to wait for.
inline void prefetch(const Group& group, const Slot* slots) {
  for (const Offsets& offsets : {group.a, group.b}) {
    for (const std::uint32_t offset : offsets) {
      __builtin_prefetch(bytes_of(slots, offset), 1);
      __builtin_prefetch(bytes_of(slots, offset) + 64, 1);
    }
  }
}

/// Puts the impulses p on the slots.
inline void add_impulse(const Group& group, const Lanes3& p, Slot* slots) {
  const Lanes3 q{-p.x, -p.y, -p.z};
  add({q, cross(p, group.arm_a)}, group.a, slots);
  add({p, cross(group.arm_b, p)}, group.b, slots);
}

/// E p.
inline Lanes3 comply(const Group& group, const GroupCompliance& c, const Lanes3& p) {
  const Lanes3 tangent2 = cross(group.normal, c.tangent1);
  return (c.e.x * dot(group.normal, p)) * group.normal + (c.e.y * dot(c.tangent1, p)) * c.tangent1 +
         (c.e.z * dot(tangent2, p)) * tangent2;
}

/// A point of the cones: `along` normal + `across` times the tangential part that was given.
struct Projected {
  Lanes along, across;
};

/// The point of each cone nearest to `g_n` normal + `t` in the metric diag(1/m_n, 1/m_t, 1/m_t): project_cone3() with one
/// root and one division.
inline Projected project(const Lanes& g_n, const Lanes3& t, const Lanes& m_n, const Lanes& m_t, const Lanes& mu) {
  const Lanes zero{}, one = all(1.0);
  const Lanes length = root(dot(t, t));
  const auto inside = (g_n >= zero) & (length <= mu * g_n);
  const Lanes above = m_t * g_n + mu * m_n * length;  // n = above / (m_t + mu^2 m_n)
  const auto surface = above > zero;
  const Lanes scale = above / ((m_t + mu * mu * m_n) * length);
  // Without a tangential part n is g_n, which is inside, or pulls.
  return {inside ? g_n : (surface ? scale * length : zero), inside ? one : (surface ? mu * scale : zero)};
}

/// || x - P(x - s u) || / s of four contacts, as the judge has it [m/s]; infinite where it is no number, 0 where s is.
inline Lanes natural_map(const Group& group, const Lanes& s, const Lanes3& x, const Lanes3& u) {
  const Lanes one = all(1.0), infinite = all(std::numeric_limits<double>::infinity());
  const Lanes3 z = x - s * u;
  const Lanes z_n = dot(group.normal, z);
  const Lanes3 t = z - z_n * group.normal;
  const Projected to = project(z_n, t, one, one, group.friction);
  const Lanes3 d = x - (to.along * group.normal + to.across * t);
  const Lanes raw = root(dot(d, d)) / s;
  return s > Lanes{} ? (raw < infinite ? raw : infinite) : Lanes{};
}

}  // namespace scree::packed
