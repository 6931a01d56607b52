// Sequence: the order in which a sweep takes the contacts, cut into chunks.
//
// It is that of the problem, but for bodies that very many contacts touch, a drum that moves freely. Two contacts of one body
// can be updated neither side by side in a vector nor at the same time on two threads. Taken as they come, thousands in a
// row would each occupy a vector alone, and every chunk that holds one would conflict with every other.
#pragma once

#include <cstdint>
#include <vector>

#include "scree/ccp/problem.hpp"

namespace scree::sweep {

/// Keeps its memory between calls.
class Sequence {
 public:
  /// A movable body with more contacts than this is a hub.
  static constexpr std::uint32_t kHub = 512;

  /// One chunk of all contacts: those of hubs are spread evenly among the others.
  void build_whole(const CcpProblem& problem);
  /// Chunks of `length` contacts: those of hubs come last, in chunks of their own.
  void build_chunks(const CcpProblem& problem, std::size_t length);

  [[nodiscard]] const std::vector<std::uint32_t>& contacts() const { return contacts_; }
  /// Chunk c has contacts()[first()[c]] .. contacts()[first()[c + 1] - 1].
  [[nodiscard]] const std::vector<std::uint32_t>& first() const { return first_; }
  [[nodiscard]] std::size_t chunks() const { return first_.size() - 1; }
  /// Chunks before those of hubs.
  [[nodiscard]] std::size_t ordinary_chunks() const { return ordinary_chunks_; }

 private:
  /// Contacts of no hub into contacts_, the others into hub_contacts_, both in the problem's order.
  void split(const CcpProblem& problem);
  void cut(std::size_t begin, std::size_t end, std::size_t length);

  std::vector<std::uint32_t> contacts_, first_{0}, degree_, hub_contacts_, merged_;
  std::size_t ordinary_chunks_ = 0;
};

}  // namespace scree::sweep
