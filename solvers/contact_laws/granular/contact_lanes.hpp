// ContactLanes: what the passes of a contact law hand on to each other, contact by contact, one lane each.
//
// A law goes over its batch in passes, each a plain loop over lanes that becomes one over vector registers: normal force,
// cohesion, tangential spring, rolling resistance. Which passes run is decided once a batch, never once a contact. Every
// operation is correctly rounded by IEEE 754, so that a contact gets the same bits in any lane of any batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scree/interfaces/contact_law.hpp"

namespace scree::granular {

using Lane = ContactBatch::Lane;

/// Room of one batch, on the stack.
struct ContactLanes {
  alignas(64) Lane approach;           ///< speed at which the surfaces approach [m/s]
  alignas(64) Lane normal;             ///< force on b along the normal, > 0 pushes apart [N]
  alignas(64) Lane load;               ///< what friction and rolling resistance are limited by [N], >= 0
  alignas(64) Lane stiffness;          ///< normal [N/m]; 0 where the surfaces do not act on each other
  alignas(64) Lane tangent_stiffness;  ///< [N/m]; 0 where the surfaces do not act on each other
  alignas(64) Lane tangent_damping;    ///< [N s/m]
  alignas(64) Lane contact_radius;     ///< of the area of contact, of laws that know it [m]
};

/// One number for each ordered pair of materials, as ContactBatch::materials counts them.
using PairColumn = std::vector<double>;

/// The entries of a column that a batch asks for. Most batches are of one pair of materials.
inline void spread(const PairColumn& column, const ContactBatch& __restrict batch, Lane& __restrict out) {
  const double* values = column.data();
  std::uint32_t others = 0;
  for (std::size_t k = 0; k < batch.count; ++k) others |= batch.materials[k] ^ batch.materials[0];
  if (others == 0 && batch.count > 0) {
    const double value = values[batch.materials[0]];
    for (std::size_t k = 0; k < batch.count; ++k) out[k] = value;
    return;
  }
  for (std::size_t k = 0; k < batch.count; ++k) out[k] = values[batch.materials[k]];
}

inline void find_approach(const ContactBatch& __restrict batch, ContactLanes& __restrict lanes) {
  for (std::size_t k = 0; k < batch.count; ++k) {
    lanes.approach[k] = -(batch.velocity.x[k] * batch.normal.x[k] + batch.velocity.y[k] * batch.normal.y[k] +
                          batch.velocity.z[k] * batch.normal.z[k]);
  }
}

}  // namespace scree::granular
