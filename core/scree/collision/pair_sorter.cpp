#include "scree/collision/pair_sorter.hpp"

#include <algorithm>

#include "scree/base/release.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kBodiesPerChunk = 4096;
/// Up to here a sort by insertion is faster than std::sort.
constexpr std::ptrdiff_t kFewPairs = 24;

template <class Less>
void insertion_sort(ColliderPair* first, ColliderPair* last, const Less& less) {
  for (ColliderPair* i = first + 1; i < last; ++i) {
    const ColliderPair moving = *i;
    ColliderPair* hole = i;
    for (; hole > first && less(moving, hole[-1]); --hole) *hole = hole[-1];
    *hole = moving;
  }
}

}  // namespace

std::span<const ColliderPair> PairSorter::sort(std::span<const std::vector<ColliderPair>> parts,
                                               std::span<const BodyIndex> body, std::size_t body_count,
                                               const Executor& executor) {
  // Counts land one place late, so that after the scatter first_[i] is where the pairs of body i begin.
  first_.assign(body_count + 2, 0);
  std::size_t total = 0;
  for (const auto& part : parts) {
    total += part.size();
    for (const ColliderPair& pair : part) ++first_[body[pair.a] + 2];
  }
  for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
  sorted_.resize(total);
  for (const auto& part : parts) {
    for (const ColliderPair& pair : part) sorted_[first_[body[pair.a] + 1]++] = pair;
  }

  const auto less = [&](const ColliderPair& l, const ColliderPair& r) {
    if (body[l.b] != body[r.b]) return body[l.b] < body[r.b];
    return l.a != r.a ? l.a < r.a : l.b < r.b;
  };
  executor.for_chunks(body_count, kBodiesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      ColliderPair* const first = sorted_.data() + first_[i];
      ColliderPair* const last = sorted_.data() + first_[i + 1];
      if (last - first > kFewPairs) {
        std::sort(first, last, less);
      } else if (last - first > 1) {
        insertion_sort(first, last, less);
      }
    }
  });
  const auto same = [](const ColliderPair& l, const ColliderPair& r) { return l.a == r.a && l.b == r.b; };
  sorted_.erase(std::unique(sorted_.begin(), sorted_.end(), same), sorted_.end());
  return sorted_;
}

void PairSorter::release_buffers() { release(first_, sorted_); }

}  // namespace scree
