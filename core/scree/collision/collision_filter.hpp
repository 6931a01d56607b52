// CollisionFilter: which bodies never meet, wherever they are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "scree/model/body.hpp"

namespace scree {

/// Groups of bodies of which some do not meet, and single pairs of bodies that do not, such as bodies that a joint
/// connects. Asked for each candidate pair before its boxes are compared; costs nothing while all meet all.
class CollisionFilter {
 public:
  static constexpr std::size_t kMostGroups = 32;

  CollisionFilter() { mask_.fill(~std::uint32_t{0}); }

  /// Lets bodies of these two groups (which may be one) meet, or not. All do at first.
  void set_groups_meet(CollisionGroup a, CollisionGroup b, bool meet);
  [[nodiscard]] bool groups_meet(CollisionGroup a, CollisionGroup b) const { return ((mask_[a] >> b) & 1u) != 0; }

  /// Keeps two bodies apart from each other's contacts, in either order. Counted: what was excluded twice, by two
  /// joints, has to be admitted twice. Bodies need not exist (any more).
  void exclude(BodyId a, BodyId b);
  /// Takes one exclusion back. @throws std::logic_error when there is none.
  void admit(BodyId a, BodyId b);
  /// Counts the changes so far: who keeps pairs of bodies must ask for them again when it is another.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Excluded pairs, each once.
  [[nodiscard]] std::size_t excluded_pairs() const { return excluded_.size(); }

  /// False while all bodies may meet all.
  [[nodiscard]] bool is_active() const { return groups_differ_ || !excluded_.empty(); }

  /// Translates ids into the indices of these bodies, for allows().
  void look_up(const BodyView& bodies);
  /// True when these two bodies of the last look_up() may meet.
  [[nodiscard]] bool allows(BodyIndex a, BodyIndex b) const {
    const Record one = records_[a], other = records_[b];
    if (!groups_meet(one.group, other.group)) return false;
    return !one.listed || !other.listed || !is_excluded(a, b);
  }

 private:
  struct Record {
    CollisionGroup group = 0;
    bool listed = false;  // in an excluded pair
  };
  struct Exclusion {
    std::pair<BodyId, BodyId> pair;  // smaller id first
    std::uint32_t count;
  };
  [[nodiscard]] bool is_excluded(BodyIndex a, BodyIndex b) const;

  std::array<std::uint32_t, kMostGroups> mask_;  // bit g: meets group g
  bool groups_differ_ = false;
  std::uint64_t version_ = 0;
  std::vector<Exclusion> excluded_;                           // sorted
  std::vector<Record> records_;                               // by body
  std::vector<std::pair<BodyIndex, BodyIndex>> excluded_at_;  // sorted: ids and indices have one order
};

}  // namespace scree
