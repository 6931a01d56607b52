#include "scree/collision/pair_sorter.hpp"

#include <algorithm>
#include <atomic>

#include "scree/base/release.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kBodiesPerChunk = 4096;
/// Up to here a sort by insertion is faster than std::sort.
constexpr std::ptrdiff_t kFewPairs = 24;

template <class Less>
void sort_few(ColliderPair* first, ColliderPair* last, const Less& less) {
  if (last - first > kFewPairs) {
    std::sort(first, last, less);
    return;
  }
  for (ColliderPair* i = first + 1; i < last; ++i) {
    const ColliderPair moving = *i;
    ColliderPair* hole = i;
    for (; hole > first && less(moving, hole[-1]); --hole) *hole = hole[-1];
    *hole = moving;
  }
}

bool same(const ColliderPair& l, const ColliderPair& r) { return l.a == r.a && l.b == r.b; }

/// True when every body has one collider, at its own index.
bool one_each(std::span<const BodyIndex> body, std::size_t body_count) {
  if (body.size() != body_count) return false;
  BodyIndex differ = 0;
  for (std::size_t i = 0; i < body.size(); ++i) differ |= body[i] ^ static_cast<BodyIndex>(i);
  return differ == 0;
}

}  // namespace

template <class BodyOf>
void PairSorter::count_and_scatter(std::span<const std::vector<ColliderPair>> parts, std::size_t body_count,
                                   const BodyOf& body_of) {
  // Counts land one place late, so that after the scatter first_[i] is where the pairs of body i begin.
  first_.assign(body_count + 2, 0);
  std::size_t total = 0;
  for (const auto& part : parts) {
    total += part.size();
    for (const ColliderPair& pair : part) ++first_[body_of(pair.a) + 2];
  }
  for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
  sorted_.resize(total);
  for (const auto& part : parts) {
    for (const ColliderPair& pair : part) sorted_[first_[body_of(pair.a) + 1]++] = pair;
  }
}

template <class Less>
void PairSorter::sort_bodies(std::size_t body_count, const Less& less, const Executor& executor) {
  std::atomic<bool> doubles{false};
  executor.for_chunks(body_count, kBodiesPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sort_few(sorted_.data() + first_[i], sorted_.data() + first_[i + 1], less);
    }
    const auto at = [&](std::size_t body) { return sorted_.begin() + first_[body]; };
    if (std::adjacent_find(at(begin), at(end), same) != at(end)) doubles = true;
  });
  // Doubles have one body a, so they never lie on two sides of the end of a chunk.
  if (doubles) sorted_.erase(std::unique(sorted_.begin(), sorted_.end(), same), sorted_.end());
}

std::span<const ColliderPair> PairSorter::sort(std::span<const std::vector<ColliderPair>> parts,
                                               std::span<const BodyIndex> body, std::size_t body_count,
                                               const Executor& executor) {
  if (one_each(body, body_count)) {
    count_and_scatter(parts, body_count, [](ColliderIndex i) { return i; });
    sort_bodies(
        body_count, [](const ColliderPair& l, const ColliderPair& r) { return l.b < r.b; }, executor);
  } else {
    count_and_scatter(parts, body_count, [&](ColliderIndex i) { return body[i]; });
    const auto less = [&](const ColliderPair& l, const ColliderPair& r) {
      if (body[l.b] != body[r.b]) return body[l.b] < body[r.b];
      return l.a != r.a ? l.a < r.a : l.b < r.b;
    };
    sort_bodies(body_count, less, executor);
  }
  return sorted_;
}

void PairSorter::release_buffers() { release(first_, sorted_); }

}  // namespace scree
