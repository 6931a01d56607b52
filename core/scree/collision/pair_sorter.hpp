// PairSorter: brings pairs of colliders into the order of contacts.
#pragma once

#include <span>
#include <vector>

#include "scree/base/uninitialised.hpp"
#include "scree/collision/collider.hpp"

namespace scree {

class Executor;

/// Sorts by (body a, body b, collider a, collider b) and drops doubles. A
/// counting sort over the first body, then small sorts: linear for bodies that
/// meet a bounded number of others. Buffers are kept between calls.
class PairSorter {
 public:
  /// `body` gives the body of every collider; bodies are below `body_count`.
  /// The result is valid until the next call.
  std::span<const ColliderPair> sort(std::span<const std::vector<ColliderPair>> parts, std::span<const BodyIndex> body,
                                     std::size_t body_count, const Executor& executor);

  /// Frees all memory; ends what sort() returned.
  void release_buffers();

 private:
  template <class BodyOf>
  void count_and_scatter(std::span<const std::vector<ColliderPair>> parts, std::size_t body_count,
                         const BodyOf& body_of);
  template <class Less>
  void sort_bodies(std::size_t body_count, const Less& less, const Executor& executor);

  std::vector<std::uint32_t> first_;  // pair of each body a
  UninitialisedVector<ColliderPair> sorted_;
};

}  // namespace scree
