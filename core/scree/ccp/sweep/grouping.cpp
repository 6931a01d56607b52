#include "scree/ccp/sweep/grouping.hpp"

namespace scree::sweep {

namespace {
template <std::size_t lanes>
constexpr std::size_t kQueue = 12 * lanes;
}

template <std::size_t lanes>
void GroupingOf<lanes>::build(const CcpProblem& problem, const Sequence& sequence) {
  groups.clear();
  first.clear();
  std::array<std::uint32_t, kQueue<lanes>> queue{};
  const auto share = [&](std::uint32_t i, std::uint32_t j) {
    const CcpContact &x = problem.contacts[i], &y = problem.contacts[j];
    const auto meets = [&](std::uint32_t k) { return (k == y.a || k == y.b) && problem.inverse_mass[k] > 0.0; };
    return meets(x.a) || meets(x.b);
  };
  for (std::size_t chunk = 0; chunk < sequence.chunks(); ++chunk) {
    first.push_back(static_cast<std::uint32_t>(groups.size()));
    const std::size_t end = sequence.first()[chunk + 1];
    std::size_t next = sequence.first()[chunk], waiting = 0;
    while (next < end || waiting > 0) {
      while (waiting < kQueue<lanes> && next < end) queue[waiting++] = sequence.contacts()[next++];
      // One walk through the queue: what fits goes into the group, the rest moves up.
      std::array<std::uint32_t, lanes> group;
      group.fill(kNoContact);
      std::size_t members = 0, kept = 0;
      for (std::size_t k = 0; k < waiting; ++k) {
        bool fits = members < group.size();
        for (std::size_t g = 0; g < members && fits; ++g) fits = !share(queue[k], group[g]);
        if (fits) {
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
