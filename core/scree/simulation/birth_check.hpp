// BirthCheck: no body is born inside another.
//
// Sources see bodies by their bounding spheres, walls not at all; the first search for contacts after a birth knows the
// truth.
#pragma once

#include <span>
#include <vector>

#include "scree/collision/contact.hpp"
#include "scree/model/body.hpp"
#include "scree/simulation/part.hpp"
#include "scree/simulation/scene_model.hpp"

namespace scree {

/// The bodies that sources added in this step, until somebody has looked at their contacts.
class BirthCheck {
 public:
  /// Greatest overlap of a newborn body, over the radius of the smaller of the two [1].
  static constexpr double kAllowed = 0.05;

  /// Forgets the births of the last step.
  void start() { births_.clear(); }
  /// What is added from now on, from index `first`, comes from `source`, which outlives the step.
  void expect(BodyIndex first, const PartInfo& source) { births_.push_back({first, &source}); }
  /// The first body that was born and not looked at yet, among `count` bodies; `count` when there is none.
  [[nodiscard]] BodyIndex first_unseen(std::size_t count) const {
    return births_.empty() ? static_cast<BodyIndex>(count) : births_.front().first;
  }
  /// Looks at the contacts of the newborn, once; `known` are the bodies of the scene, by id.
  /// @throws Error (usage) naming the source, the bodies and the depth when one overlaps by more than allowed.
  void check(const BodyView& bodies, std::span<const Contact> contacts, std::span<const SceneBody> known);

 private:
  struct Birth {
    BodyIndex first;
    const PartInfo* source;
  };
  std::vector<Birth> births_;
};

}  // namespace scree
