// How a ContactSweep holds its contacts, with what a sweep does with them: solvers are written once, as templates over it.
//
//     Lanes3& impulse(k)              impulses of group k [N s], in the frames of the contacts
//     void update(k)                  the Gauss-Seidel update of group k
//     void prefetch(k)                asks for the bodies of group k, which will be updated soon
//     Lanes metric_product(k, x, y)   x^T d y for differences of impulses of group k, d the metric of the steps [J]
//     Lanes linear(k)                 r^T g + 1/2 g^T E g of group k [J]
//
// (Contacts of spheres could do with 136 bytes in place of 192: arms along the normal, impulses as world vectors. With the
// prefetch it won 8 % of a sweep over a bed of 64 000 spheres, and lost it again in turning impulses for the residual.)
#pragma once

#include "scree/ccp/sweep/update.hpp"

namespace scree::sweep {

/// Asks for the bodies of four contacts, to read and write them. (Inlined always: GCC 12 drops calls that do nothing else.)
[[gnu::always_inline]] inline void prefetch_bodies(const Body* bodies, const std::array<std::uint32_t, 4>& index) {
  for (const std::uint32_t body : index) __builtin_prefetch(bodies + body, 1);
}

/// Visits groups first .. last - 1, or backwards. Bodies lie about in memory: those of later groups are asked for early
/// (on a bed of 64 000 spheres it saves a third of the time; two to ten groups ahead make no difference).
template <class Layout, class Visit>
void for_groups(const Layout& layout, std::size_t first, std::size_t last, bool backward, const Visit& visit) {
  constexpr std::size_t kAhead = 4;
  for (std::size_t k = first; k < last; ++k) {
    const std::size_t group = backward ? first + (last - 1 - k) : k;
    if (k + kAhead < last) layout.prefetch(backward ? group - kAhead : group + kAhead);
    visit(group);
  }
}

/// Pointers into a ContactSweep. `isotropic`: all inverse inertias are multiples of the identity.
template <bool isotropic, bool compliant>
struct Layout {
  Group* groups;
  const Lanes3* compliance;
  Body* bodies;
  const Inertia* inertias;

  [[nodiscard]] Lanes3& impulse(std::size_t k) const { return groups[k].g; }
  void update(std::size_t k) const {
    sweep::update<isotropic, compliant>(groups[k], compliant ? compliance + k : nullptr, bodies, inertias);
  }
  [[gnu::always_inline]] void prefetch(std::size_t k) const {
    prefetch_bodies(bodies, groups[k].a);
    prefetch_bodies(bodies, groups[k].b);
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

}  // namespace scree::sweep
