#include "scree/ccp/sweep/grouping.hpp"

#include <algorithm>
#include <span>

namespace scree::sweep {

namespace {
template <std::size_t lanes>
constexpr std::size_t kQueue = 12 * lanes;

/// Lanes of a group that may have the same hub: just enough to take its contacts along with the others, a quarter more than their
/// share since they do not come evenly.
std::size_t hub_lanes(const CcpProblem& problem, const Sequence& sequence, std::size_t chunk, std::size_t lanes) {
  if (sequence.hubs() == 0) return lanes;
  std::size_t of_hubs = 0;
  const std::size_t first = sequence.first()[chunk], last = sequence.first()[chunk + 1];
  for (std::size_t at = first; at < last; ++at) {
    const CcpContact& c = problem.contacts[sequence.contacts()[at]];
    of_hubs += sequence.hub(c.a) != Sequence::kNoHub || sequence.hub(c.b) != Sequence::kNoHub ? 1 : 0;
  }
  const std::size_t wanted = 5 * lanes * of_hubs / 4;
  return std::max<std::size_t>(1, (wanted + last - first - 1) / (last - first));
}

}  // namespace

template <std::size_t lanes>
void GroupingOf<lanes>::build(const CcpProblem& problem, const Sequence& sequence) {
  groups.clear();
  first.clear();
  std::array<std::uint32_t, kQueue<lanes>> queue{};
  // What a group may have once, and what it may have `most` times.
  const auto once = [&](std::uint32_t k) {
    return problem.inverse_mass[k] > 0.0 && sequence.hub(k) == Sequence::kNoHub;
  };
  const auto has = [&](std::uint32_t i, std::uint32_t k) {
    return problem.contacts[i].a == k || problem.contacts[i].b == k;
  };
  const auto fits_into = [&](std::uint32_t i, std::span<const std::uint32_t> group, std::size_t most) {
    if (group.size() == lanes) return false;
    for (const std::uint32_t k : {problem.contacts[i].a, problem.contacts[i].b}) {
      const bool hub = sequence.hub(k) != Sequence::kNoHub;
      if (!hub && !once(k)) continue;
      const auto others = std::count_if(group.begin(), group.end(), [&](std::uint32_t j) { return has(j, k); });
      if (static_cast<std::size_t>(others) >= (hub ? most : 1)) return false;
    }
    return true;
  };
  for (std::size_t chunk = 0; chunk < sequence.chunks(); ++chunk) {
    first.push_back(static_cast<std::uint32_t>(groups.size()));
    const std::size_t end = sequence.first()[chunk + 1], most = hub_lanes(problem, sequence, chunk, lanes);
    std::size_t next = sequence.first()[chunk], waiting = 0;
    while (next < end || waiting > 0) {
      while (waiting < kQueue<lanes> && next < end) queue[waiting++] = sequence.contacts()[next++];
      // One walk through the queue: what fits goes into the group, the rest moves up.
      std::array<std::uint32_t, lanes> group;
      group.fill(kNoContact);
      std::size_t members = 0, kept = 0;
      for (std::size_t k = 0; k < waiting; ++k) {
        if (fits_into(queue[k], {group.data(), members}, most)) {
          group[members++] = queue[k];
        } else {
          queue[kept++] = queue[k];
        }
      }
      waiting = kept;
      groups.push_back(group);
    }
  }
  first.push_back(static_cast<std::uint32_t>(groups.size()));
}

template struct GroupingOf<4>;
template struct GroupingOf<8>;

}  // namespace scree::sweep
