// FollowedBodies: the bodies that an observer was told to look at by name, and the contacts that they take part in.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scree/collision/contact.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/scene_services.hpp"

namespace scree {

/// A contact as one of its two bodies sees it.
struct BodyContact {
  std::size_t slot = 0;         ///< of the followed body
  std::size_t contact = 0;      ///< index into the ContactView
  BodyIndex self = 0;           ///< the followed body
  BodyIndex other = 0;          ///< what touches it
  std::uint32_t primitive = 0;  ///< of the followed body
  double sign = 1.0;            ///< +1 when the followed body is b, which impulses are given for; -1 when it is a
};

/// Names in the order of the scene; slots count them.
class FollowedBodies {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr BodyIndex kGone = ~BodyIndex{0};

  /// Reads the list of names `key`. @throws Error (usage) for an unknown name, with those that exist and a suggestion, and
  /// for one that is listed twice.
  void setup(const Options& options, std::string_view key, const SceneServices& services);
  /// Finds the bodies in the view of a step; before index(), slot() and visit().
  void locate(const BodyView& bodies);

  [[nodiscard]] std::size_t size() const { return ids_.size(); }
  [[nodiscard]] const std::string& name(std::size_t slot) const { return names_[slot]; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] BodyId id(std::size_t slot) const { return ids_[slot]; }
  /// Index in the view, or kGone after a sink has taken it.
  [[nodiscard]] BodyIndex index(std::size_t slot) const { return indices_[slot]; }
  /// The slot of a body of the view, or kNone.
  [[nodiscard]] std::uint32_t slot(BodyIndex body) const { return slots_[body]; }

  /// Calls `look(BodyContact)` for every contact of a followed body, in the order of contacts; first as a, then as b when both
  /// are followed.
  template <class Look>
  void visit(const ContactView& contacts, Look&& look) const {
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Contact& c = contacts.contact[k];
      if (slots_[c.a] != kNone) look(BodyContact{slots_[c.a], k, c.a, c.b, c.primitive_a, -1.0});
      if (slots_[c.b] != kNone) look(BodyContact{slots_[c.b], k, c.b, c.a, c.primitive_b, 1.0});
    }
  }

 private:
  std::vector<std::string> names_;
  std::vector<BodyId> ids_;
  std::vector<BodyIndex> indices_;
  std::vector<std::uint32_t> slots_;  // by index of body
};

}  // namespace scree
