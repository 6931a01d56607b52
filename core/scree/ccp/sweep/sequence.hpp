// Sequence: the order in which a sweep takes the contacts, cut into chunks.
//
// It is that of the problem, but for bodies that very many contacts touch, a drum that moves freely. Two contacts of one body
// can be updated neither side by side in a vector nor at the same time on two threads. Taken as they come, thousands in a
// row would each occupy a vector alone, and every chunk that holds one would conflict with every other. Sweeps over copies of
// such bodies (hub_copies.hpp) do not mind; for others their contacts are spread.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "scree/ccp/problem.hpp"

namespace scree::sweep {

/// Keeps its memory between calls.
class Sequence {
 public:
  /// A movable body with more contacts than this is a hub.
  static constexpr std::uint32_t kHub = 256;
  static constexpr std::uint32_t kNoHub = std::numeric_limits<std::uint32_t>::max();

  /// One chunk of all contacts, for sweeps without copies: those of hubs are spread evenly among the others.
  void build_spread(const CcpProblem& problem);
  /// For sweeps over copies of the hubs, in chunks of `length` contacts, or one of all where it is 0: those of hubs come beside
  /// the other contacts of their partners.
  void build_split(const CcpProblem& problem, std::size_t length);

  [[nodiscard]] const std::vector<std::uint32_t>& contacts() const { return contacts_; }
  /// Chunk c has contacts()[first()[c]] .. contacts()[first()[c + 1] - 1].
  [[nodiscard]] const std::vector<std::uint32_t>& first() const { return first_; }
  [[nodiscard]] std::size_t chunks() const { return first_.size() - 1; }
  /// Hubs of build_split(), and the rank of a body among them, or kNoHub.
  [[nodiscard]] std::size_t hubs() const { return hubs_; }
  [[nodiscard]] std::uint32_t hub(std::uint32_t body) const { return hubs_ == 0 ? kNoHub : rank_[body]; }

 private:
  void count(const CcpProblem& problem);
  void sort_by_partner(const CcpProblem& problem);
  void cut(std::size_t length);

  std::vector<std::uint32_t> contacts_, first_{0}, degree_, hub_contacts_, merged_, rank_, cursor_;
  std::size_t hubs_ = 0;
};

}  // namespace scree::sweep
