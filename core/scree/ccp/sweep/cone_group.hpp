// The step of block_step.hpp for four cones of 5 or 6 rows side by side, which share no movable body.
//
// A step waits for roots and quotients again and again; four of them wait together. Cones of 5 rows are those of 6 without
// spinning. The projection is that of rolling_cone.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "scree/ccp/sweep/update.hpp"
#include "scree/math/lanes.hpp"

namespace scree::sweep {

/// Rows: normal, tangent 1, 2, spin, rolling 1, 2; a lane each.
using ConeRows = std::array<Lanes, 6>;

/// Four cones between two bodies each. A lane without one has zeros everywhere, but d of 1. Immovable bodies, and those of empty
/// lanes, are the one that stands for nothing (update.hpp).
struct alignas(64) ConeGroup {
  std::array<std::uint32_t, 4> a, b;     ///< bodies
  std::array<std::uint32_t, 4> row;      ///< first row of the block; kNoContact: an empty lane
  std::array<std::uint32_t, 4> rows;     ///< 5 or 6
  Lanes d_n, d_t, d_s, d_r;              ///< the metric [1/kg]
  Lanes friction, spinning, rolling;     ///< [1]
  std::array<Lanes3, 3> along;           ///< the first three rows: of b; of a the opposite [1]
  std::array<Lanes3, 3> turn_a, turn_b;  ///< their moments [m]
  std::array<Lanes3, 3> turn;            ///< the others: of b; of a the opposite [m]
  std::array<Lanes, 36> matrix;          ///< A, row by row [1/kg]
};

inline Lanes larger(const Lanes& x, const Lanes& y) { return x > y ? x : y; }

/// How much part k adds to numerator and denominator of the nearest normal part: all or nothing.
struct ConePart {
  Lanes mu, d, length;

  /// d_j mu_j max(0, mu_k ||g_j|| - mu_j ||g_k||) of this part j.
  [[nodiscard]] Lanes over(const ConePart& k) const { return d * mu * larger(Lanes{}, k.mu * length - mu * k.length); }
};

inline void project_group(const ConeGroup& c, ConeRows& g) {
  const Lanes zero{}, one = {1.0, 1.0, 1.0, 1.0};
  const ConePart t{c.friction, c.d_t, root(g[1] * g[1] + g[2] * g[2])};
  const ConePart s{c.spinning, c.d_s, root(g[3] * g[3])};
  const ConePart r{c.rolling, c.d_r, root(g[4] * g[4] + g[5] * g[5])};
  const auto inside =
      (g[0] >= zero) & (t.length <= t.mu * g[0]) & (s.length <= s.mu * g[0]) & (r.length <= r.mu * g[0]);
  Lanes numerator = c.d_n * g[0], denominator = c.d_n;
  const auto add = [&](const ConePart& k, const Lanes& others) {
    const auto beyond = c.d_n * (k.length - k.mu * g[0]) > others;
    const Lanes weight = k.d * k.mu;
    numerator += beyond ? weight * k.length : zero;
    denominator += beyond ? weight * k.mu : zero;
  };
  add(t, s.over(t) + r.over(t));
  add(s, t.over(s) + r.over(s));
  add(r, t.over(r) + s.over(r));
  const Lanes n = numerator / denominator;
  const auto open = n <= zero;
  const auto scale_of = [&](const ConePart& k) {
    const Lanes most = k.mu * n;
    const Lanes cut = k.length <= most ? one : most / k.length;
    return inside ? one : (open ? zero : cut);
  };
  const Lanes by_t = scale_of(t), by_s = scale_of(s), by_r = scale_of(r);
  g[0] = inside ? g[0] : (open ? zero : n);
  g[1] *= by_t, g[2] *= by_t, g[3] *= by_s, g[4] *= by_r, g[5] *= by_r;
}

inline bool all_small(const Lanes& change, const Lanes& bound) {
  bool all = true;
  for (int k = 0; k < 4; ++k) all = all && change[k] <= bound[k];
  return all;
}

/// Moves the impulses `g`, whose velocities are `v`, by at most `steps` steps, as BlockSteps::advance() does; `small` is the
/// share of the first change (squared) at which the others are not worth taking.
inline void step_group(const ConeGroup& c, double omega, int steps, double small, ConeRows& v, ConeRows& g) {
  const Lanes by_n = omega / c.d_n, by_t = omega / c.d_t, by_s = omega / c.d_s, by_r = omega / c.d_r;
  Lanes bound{};
  for (int step = 1;; ++step) {
    ConeRows moved = {g[0] - by_n * v[0], g[1] - by_t * v[1], g[2] - by_t * v[2],
                      g[3] - by_s * v[3], g[4] - by_r * v[4], g[5] - by_r * v[5]};
    project_group(c, moved);
    for (std::size_t i = 0; i < 6; ++i) {
      const Lanes next = moved[i];
      moved[i] = next - g[i];
      g[i] = next;
    }
    if (step == steps) return;
    const Lanes change = c.d_n * moved[0] * moved[0] + c.d_t * (moved[1] * moved[1] + moved[2] * moved[2]) +
                         c.d_s * moved[3] * moved[3] + c.d_r * (moved[4] * moved[4] + moved[5] * moved[5]);
    if (step == 1) bound = small * change;
    if (all_small(change, bound)) return;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) v[i] += c.matrix[6 * i + j] * moved[j];
    }
  }
}

/// D_i^T w of four cones.
inline void velocities_of(const ConeGroup& c, const Four& a, const Four& b, ConeRows& u) {
  const Lanes3 v = b.linear - a.linear, omega = b.angular - a.angular;
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = dot(c.along[k], v) + dot(c.turn_a[k], a.angular) + dot(c.turn_b[k], b.angular);
    u[k + 3] = dot(c.turn[k], omega);
  }
}

/// w += M^-1 D_i `change` of four cones.
template <bool isotropic>
inline void push_group(const ConeGroup& c, const ConeRows& change, const Inertia* inertias, Four& a, Four& b) {
  const auto sum = [](const std::array<Lanes3, 3>& rows, const Lanes* x) {
    return x[0] * rows[0] + x[1] * rows[1] + x[2] * rows[2];
  };
  const Lanes3 p = sum(c.along, change.data()), moment = sum(c.turn, change.data() + 3);
  a.linear = a.linear - a.inverse_mass * p;
  b.linear = b.linear + b.inverse_mass * p;
  a.angular = a.angular + turned<isotropic>(a, inertias, c.a, sum(c.turn_a, change.data()) - moment);
  b.angular = b.angular + turned<isotropic>(b, inertias, c.b, sum(c.turn_b, change.data()) + moment);
}

}  // namespace scree::sweep
