// Puts contacts into groups, one contact a vector lane, that share no movable body but hubs, which a few lanes may have.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "scree/ccp/sweep/sequence.hpp"

namespace scree::sweep {

inline constexpr std::uint32_t kNoContact = std::numeric_limits<std::uint32_t>::max();

/// The contacts of each group, in the order of a sweep; for 4 and 8 lanes.
template <std::size_t lanes>
struct GroupingOf {
  std::vector<std::array<std::uint32_t, lanes>> groups;  ///< kNoContact: an empty lane
  std::vector<std::uint32_t> first;                      ///< first group of each chunk, and the end

  /// Groups never reach across chunks. Contacts are taken in order as far as they
  /// fit, from a short queue, so that memory is still walked through in order.
  void build(const CcpProblem& problem, const Sequence& sequence);
};

using Grouping = GroupingOf<4>;

}  // namespace scree::sweep
