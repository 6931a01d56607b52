// ContactLog: which contacts are new in a step, and which of a pair's new contacts an impact is shared by.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/contact_memory.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// Remembers which contacts acted (acts() in contact_motion.hpp) in the last step.
class ContactLog {
 public:
  /// Looks at the contacts of a step, once a step. Contacts are sorted, as steppers give them.
  void look(const BodyView& bodies, const ContactView& contacts);

  /// True when contact k acts, and did not in the step before.
  [[nodiscard]] bool is_new(std::size_t k) const { return share_[k] > 0.0; }
  /// Of an impact of two bodies, what contact k has of it: its part of the impulse, along the normal, of all new contacts between the
  /// two; 0 when it is not new. The shares of a pair sum up to one, so that a box that lands on four corners lands once.
  [[nodiscard]] double share(std::size_t k) const { return share_[k]; }
  /// Number of contacts that act.
  [[nodiscard]] std::size_t loaded() const { return loaded_.size(); }

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  void share_out(const ContactView& contacts);

  std::vector<ContactKey> loaded_, before_;  // sorted
  std::vector<double> share_;                // by contact
};

}  // namespace scree
