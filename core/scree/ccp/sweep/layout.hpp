// The two ways in which a ContactSweep may hold its contacts, with one face: solvers are written once, as templates over it.
//
//     Lanes3& impulse(k)              impulses of group k [N s], in the layout's own frame
//     void update(k)                  the Gauss-Seidel update of group k
//     Lanes metric_product(k, x, y)   x^T d y for differences of impulses of group k, d the metric of the steps [J]
//     Lanes linear(k)                 r^T g + 1/2 g^T E g of group k [J]
#pragma once

#include "scree/ccp/sweep/sphere_update.hpp"
#include "scree/ccp/sweep/update.hpp"

namespace scree::sweep {

/// Contacts of every sort. Impulses are in the frames of the contacts.
template <bool isotropic, bool compliant>
struct GeneralLayout {
  Group* groups;
  const Lanes3* compliance;
  Body* bodies;
  const Inertia* inertias;

  [[nodiscard]] Lanes3& impulse(std::size_t k) const { return groups[k].g; }
  void update(std::size_t k) const {
    sweep::update<isotropic, compliant>(groups[k], compliant ? compliance + k : nullptr, bodies, inertias);
  }
  [[nodiscard]] Lanes metric_product(std::size_t k, const Lanes3& x, const Lanes3& y) const {
    const Group& group = groups[k];
    const Lanes zero{};
    const Lanes product = x.x * y.x / group.step_n + (x.y * y.y + x.z * y.z) / group.step_t;
    return group.step_n > zero ? product : zero;  // lanes without a contact have no metric
  }
  [[nodiscard]] Lanes linear(std::size_t k) const {
    const Lanes3& g = groups[k].g;
    Lanes sum = dot(groups[k].r, g);
    if constexpr (compliant) {
      const Lanes3& e = compliance[k];
      sum += 0.5 * (e.x * g.x * g.x + e.y * g.y * g.y + e.z * g.z * g.z);
    }
    return sum;
  }
};

/// Contacts of spheres, without compliance. Impulses are world vectors.
struct SphereLayout {
  SphereGroup* groups;
  Body* bodies;

  [[nodiscard]] Lanes3& impulse(std::size_t k) const { return groups[k].g; }
  void update(std::size_t k) const { sweep::update(groups[k], bodies); }
  [[nodiscard]] Lanes metric_product(std::size_t k, const Lanes3& x, const Lanes3& y) const {
    const SphereGroup& group = groups[k];
    const Lanes zero{};
    const Lanes along = dot(group.normal, x) * dot(group.normal, y);
    const Lanes product = along / group.step_n + (dot(x, y) - along) / group.step_t;
    return group.step_n > zero ? product : zero;
  }
  [[nodiscard]] Lanes linear(std::size_t k) const { return dot(groups[k].r, groups[k].g); }
};

}  // namespace scree::sweep
