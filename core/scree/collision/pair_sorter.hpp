// PairSorter: brings candidates into the order of their colliders.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scree/base/uninitialised.hpp"
#include "scree/collision/collider.hpp"

namespace scree {

/// Candidates by their first collider: a counting sort that keeps the second one alone, four bytes a pair; the few pairs of a
/// collider are sorted when they are asked for. Linear for colliders that meet a bounded number of others. Buffers are
/// kept between calls.
class PairSorter {
 public:
  /// Takes candidates in any order, either way round, some perhaps twice. Colliders are below `colliders`.
  void sort(std::span<const CandidatePair> candidates, std::size_t colliders);

  /// Number of pairs, doubles included.
  [[nodiscard]] std::size_t size() const { return other_.size(); }
  /// Where the pairs of collider a begin, in the order of a; a may be one beyond the last.
  [[nodiscard]] std::size_t begin(std::size_t a) const { return first_[a]; }

  /// Gives all pairs {a, b}, a < b, of the colliders a in first..last-1, sorted, doubles side by side, to `take`, some
  /// hundreds at a time. May be called from several threads for different colliders.
  void in_order(std::size_t first, std::size_t last, const std::function<void(std::span<const CandidatePair>)>& take);

  /// Frees all memory.
  void release_buffers();

 private:
  std::vector<std::uint32_t> first_;
  UninitialisedVector<ColliderIndex> other_;
};

}  // namespace scree
