// ContactReader: a part whose settings decide which values of a pair of materials it reads.
//
// What it leaves unread would be ignored without a word: core asks for every material and every pair that the scene lists, and
// refuses the scene at the place of the value.
#pragma once

#include <optional>
#include <string>

#include "scree/model/material.hpp"

namespace scree {

/// A value of a pair of materials that is not zero and without effect.
struct UnreadValue {
  std::string key;       ///< as the scene writes it: "surface_energy"
  std::string sentence;  ///< goes on from "'KEY' is not zero, but PART ": what is read, and what to do
};

/// A plugin may be one beside its interface; a ContactLaw is asked.
class ContactReader {
 public:
  virtual ~ContactReader();
  /// The first of `values` that this part does not read; nothing when it reads all that are not zero.
  [[nodiscard]] virtual std::optional<UnreadValue> unread(const ContactMaterial& values) const = 0;
};

}  // namespace scree
