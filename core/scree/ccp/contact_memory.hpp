// ContactMemory: carries the impulses of one step to the contacts of the next.
//
// Contacts are known by the ids of their bodies, their primitives and their
// feature. Old and new keys are sorted, so that one walk through both finds all
// pairs. Impulses are kept in the world: a contact's frame turns with its
// normal. Contacts that resist rolling carry an angular impulse too; where none
// does, none is stored.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "scree/collision/contact.hpp"
#include "scree/model/body.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// What stays of a contact from step to step. Ordered as contacts are: by a, b,
/// primitives, feature.
struct ContactKey {
  BodyId a = 0;
  BodyId b = 0;
  std::uint32_t primitive_a = 0;
  std::uint32_t primitive_b = 0;
  std::uint64_t feature = 0;

  auto operator<=>(const ContactKey&) const = default;  // NOLINT(modernize-use-nullptr): a fault of clang-tidy 14
};

/// The key of a contact between bodies of `bodies`.
[[nodiscard]] inline ContactKey contact_key(const BodyView& bodies, const Contact& c) {
  return {bodies.id[c.a], bodies.id[c.b], c.primitive_a, c.primitive_b, c.feature};
}

/// Impulses by contact key. Part of what a checkpoint holds.
class ContactMemory {
 public:
  /// The impulse last stored for each of `keys` (sorted) [N s], world; zero for
  /// a contact that was not there. `angular` [N m s], world: the same; may be empty.
  void recall(std::span<const ContactKey> keys, std::span<Vec3> impulse, std::span<Vec3> angular = {}) const;
  /// Replaces everything by these: `keys` sorted, impulses on b [N s], world. Takes the buffers, of equal length, and leaves
  /// its own, to be filled again.
  void store(std::vector<ContactKey>& keys, std::vector<Vec3>& impulse);
  /// As above with angular impulses [N m s]; none where `angular` is empty.
  void store(std::vector<ContactKey>& keys, std::vector<Vec3>& impulse, std::vector<Vec3>& angular);
  /// Forgets everything and frees the memory.
  void clear();
  [[nodiscard]] std::size_t size() const { return keys_.size(); }

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  std::vector<ContactKey> keys_;
  std::vector<Vec3> impulse_;
  std::vector<Vec3> angular_;  ///< empty, or one per key
};

}  // namespace scree
