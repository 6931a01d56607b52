// The direction of spg at four contacts.
#pragma once

#include "scree/ccp/packed/lane_contacts.hpp"

namespace scree::spg {

/// Sums over a pass [J], see Spg.
struct Sums {
  double slope = 0.0;      ///< u^T d
  double distance = 0.0;   ///< d^T D d
  double curvature = 0.0;  ///< d^T N d
  Sums& operator+=(const Sums& o) {
    slope += o.slope;
    distance += o.distance;
    curvature += o.curvature;
    return *this;
  }
};

/// The same, lane by lane.
struct LaneSums {
  Lanes slope{}, distance{}, curvature{};
  [[nodiscard]] Sums total() const { return {packed::total(slope), packed::total(distance), packed::total(curvature)}; }
};

/// d = P(x - alpha D^-1 u) - x of four contacts, put on their slots; u goes with x.
inline Lanes3 direction(const packed::Group& group, const Lanes3& x, const Lanes3& u, double alpha, packed::Slot* slots,
                        LaneSums& out) {
  const packed::Metric metric = packed::metric_of(group);
  const Lanes3& normal = group.normal;
  const Lanes s_n = packed::all(alpha) * metric.m_n, s_t = packed::all(alpha) * metric.m_t;
  const Lanes x_n = dot(normal, x), u_n = dot(normal, u);
  const Lanes3 across = (x - s_t * u) - (x_n - s_t * u_n) * normal;
  const packed::Projected to = packed::project(x_n - s_n * u_n, across, metric.m_n, metric.m_t, group.friction);
  const Lanes3 d = (to.along * normal + to.across * across) - x;
  packed::add_impulse(group, d, slots);
  const Lanes d_n = to.along - x_n;
  out.slope += dot(u, d);
  out.distance += metric.d_t * dot(d, d) + (metric.d_n - metric.d_t) * d_n * d_n;
  return d;
}

/// (N d)^T D^-1 (N d) of four contacts, `product` = N d.
inline Lanes product_norm(const packed::Group& group, const Lanes3& product) {
  const Lanes m_n = packed::widen(group.m_n), m_t = packed::widen(group.m_t);
  const Lanes along = dot(group.normal, product);
  return m_t * dot(product, product) + (m_n - m_t) * along * along;
}

}  // namespace scree::spg
