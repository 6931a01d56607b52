// ContactWriter: one pair's contacts, computed for "round against other" or
// "solid against plane", written the way round the pair asks for.
#pragma once

#include <algorithm>

#include "scree/collision/collider.hpp"
#include "scree/collision/contact.hpp"

namespace scree::sphere_cluster {

/// Appends contacts of one pair.
class ContactWriter {
 public:
  /// `swapped`: the first one of the computation is collider b of the pair.
  ContactWriter(const ColliderView& colliders, const ColliderPair& pair, bool swapped, ContactBuffer& out)
      : colliders_{colliders}, pair_{pair}, swapped_{swapped}, out_{out}, begin_{out.size()} {}

  [[nodiscard]] double reach() const { return pair_.reach; }

  /// A contact of a sphere of radius r about c [m] of the first, whose distance
  /// to the surface of the second is gap [m] along `out_of_second`, a unit vector
  /// from the second to the first. All in the world.
  void add(std::uint64_t feature, const Vec3& c, double r, double gap, const Vec3& out_of_second) {
    out_.push_back({colliders_.body[pair_.a], colliders_.body[pair_.b], colliders_.ordinal[pair_.a],
                    colliders_.ordinal[pair_.b], feature, c - (r + 0.5 * gap) * out_of_second,
                    swapped_ ? out_of_second : -out_of_second, gap});
  }

  /// Brings the contacts of this pair into increasing order of feature.
  void sort() {
    std::sort(out_.begin() + static_cast<std::ptrdiff_t>(begin_), out_.end(),
              [](const Contact& l, const Contact& r) { return l.feature < r.feature; });
  }

 private:
  const ColliderView& colliders_;
  ColliderPair pair_;
  bool swapped_;
  ContactBuffer& out_;
  std::size_t begin_;
};

}  // namespace scree::sphere_cluster
