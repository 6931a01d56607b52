// One step of apgd at four contacts.
#pragma once

#include "scree/ccp/packed/lane_contacts.hpp"

namespace scree::apgd {

/// Sums over a pass [J], see Apgd.
struct Sums {
  double distance = 0.0;   ///< ||x_new - y||_D^2
  double onward = 0.0;     ///< (x_new - y)^T D (y - x)
  double curvature = 0.0;  ///< (x_new - y)^T N (x_new - y)
  double quadratic = 0.0;  ///< x_new^T N x_new
  Sums& operator+=(const Sums& o) {
    distance += o.distance;
    onward += o.onward;
    curvature += o.curvature;
    quadratic += o.quadratic;
    return *this;
  }
};

/// The same, lane by lane.
struct LaneSums {
  Lanes distance{}, onward{}, curvature{}, quadratic{};
  [[nodiscard]] Sums total() const {
    return {packed::total(distance), packed::total(onward), packed::total(curvature), packed::total(quadratic)};
  }
};

/// x_new = P(y - t D^-1 u(y)) of four contacts, y = x + beta (x - x_old), put on their slots. `compliance` is read for
/// compliant problems only.
template <bool compliant>
inline Lanes3 step(const packed::Group& group, const packed::GroupCompliance* compliance, const Lanes3& x,
                   const Lanes3& x_old, double beta, double t, packed::Slot* slots, LaneSums& out) {
  const packed::Metric metric = packed::metric_of(group);
  const Lanes3& normal = group.normal;
  const Lanes3 ahead = packed::all(beta) * (x - x_old), y = x + ahead;
  Lanes3 u = packed::contact_velocity(group, slots);
  if constexpr (compliant) u = u + packed::comply(group, *compliance, y);
  const Lanes s_n = packed::all(t) * metric.m_n, s_t = packed::all(t) * metric.m_t;
  const Lanes y_n = dot(normal, y), u_n = dot(normal, u);
  const Lanes3 across = (y - s_t * u) - (y_n - s_t * u_n) * normal;
  const packed::Projected to = packed::project(y_n - s_n * u_n, across, metric.m_n, metric.m_t, group.friction);
  const Lanes3 next = to.along * normal + to.across * across;
  packed::add_impulse(group, next, slots);

  // x_new - x = d + ahead.
  const Lanes3 d = next - y;
  const Lanes d_n = to.along - y_n, more = metric.d_n - metric.d_t;
  out.distance += metric.d_t * dot(d, d) + more * d_n * d_n;
  out.onward += metric.d_t * dot(d, ahead) + more * d_n * dot(normal, ahead);
  if constexpr (compliant) {
    out.curvature += dot(d, packed::comply(group, *compliance, d));
    out.quadratic += dot(next, packed::comply(group, *compliance, next));
  }
  return next;
}

}  // namespace scree::apgd
