// ImpactBook: follows every contact from the first step in which it acts to the last, and closes it as one collision.
#pragma once

#include <cstdint>
#include <vector>

#include "contact_study/contact_log.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// A contact from its beginning to its end.
struct Collision {
  std::uint32_t material_a = 0, material_b = 0;  ///< indices; a <= b
  double normal_energy = 0.0;                    ///< 1/2 m_eff v_n^2 at the beginning [J]
  double tangential_energy = 0.0;                ///< 1/2 m_eff v_t^2 at the beginning [J]
  double dissipated = 0.0;                       ///< taken from its bodies, over its steps [J]
  double mass = 0.0;                             ///< m_eff, times the contact's share of its impact [kg]
  double speed = 0.0;                            ///< v_n at the beginning [m/s]
};

/// Contacts that are open, by key.
class ImpactBook {
 public:
  /// Looks at a step and appends the collisions that ended before it to `ended`: those whose contact carries nothing now.
  void look(const BodyView& bodies, const ContactView& contacts, std::vector<Collision>& ended);
  /// Contacts that have not ended.
  [[nodiscard]] std::size_t open() const { return keys_.size(); }
  [[nodiscard]] const std::vector<Collision>& open_collisions() const { return open_; }

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  ContactLog log_;
  std::vector<ContactKey> keys_, next_keys_;  // sorted
  std::vector<Collision> open_, next_open_;   // by key
};

}  // namespace scree
