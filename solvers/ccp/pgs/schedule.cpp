#include "schedule.hpp"

#include <algorithm>
#include <array>

namespace scree::pgs {

namespace {

constexpr std::size_t kDistance = 4;  // contacts in flight that shall not share a body

struct Pair {
  std::uint32_t a, b;
};

bool share(const CcpProblem& problem, const Pair& x, const Pair& y) {
  const auto meets = [&](std::uint32_t body) {
    return (body == y.a || body == y.b) && problem.inverse_mass[body] > 0.0;
  };
  return meets(x.a) || meets(x.b);
}

}  // namespace

void schedule(const CcpProblem& problem, std::vector<std::uint32_t>& order) {
  const std::size_t m = problem.blocks();
  order.resize(m);
  std::array<std::uint32_t, kWindow> waiting{};
  const auto pair_of = [&](std::uint32_t i) { return Pair{problem.contacts[i].a, problem.contacts[i].b}; };
  for (std::size_t begin = 0; begin < m; begin += kWindow) {
    std::size_t count = std::min(kWindow, m - begin);
    for (std::size_t k = 0; k < count; ++k) waiting[k] = static_cast<std::uint32_t>(begin + k);
    // Take the first waiting contact that shares no body with those just taken; if there is none, the first.
    for (std::size_t at = begin; count > 0; ++at) {
      std::size_t best = 0;
      for (std::size_t k = 0; k < count; ++k) {
        bool free = true;
        for (std::size_t back = 1; back <= kDistance && back <= at - begin && free; ++back) {
          free = !share(problem, pair_of(waiting[k]), pair_of(order[at - back]));
        }
        if (!free) continue;
        best = k;
        break;
      }
      order[at] = waiting[best];
      std::copy(waiting.begin() + static_cast<std::ptrdiff_t>(best) + 1,
                waiting.begin() + static_cast<std::ptrdiff_t>(count),
                waiting.begin() + static_cast<std::ptrdiff_t>(best));
      --count;
    }
  }
}

}  // namespace scree::pgs
