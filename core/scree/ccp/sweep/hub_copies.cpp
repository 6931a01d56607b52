#include "scree/ccp/sweep/hub_copies.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace scree::sweep {

void HubCopies::start(const Sequence& sequence, std::size_t slots, std::uint32_t first_copy) {
  first_copy_ = first_copy;
  slots_ = slots;
  taken_.assign(sequence.hubs() * slots, Taken{});
  copies_.clear();
  runs_.clear();
  first_run_.clear();
}

std::uint32_t HubCopies::take(const Sequence& sequence, std::uint32_t body, std::uint32_t chunk, std::uint32_t phase,
                              std::size_t slot) {
  Taken& taken = taken_[sequence.hub(body) * slots_ + slot];
  if (taken.chunk != chunk) {
    taken = {chunk, static_cast<std::uint32_t>(first_copy_ + copies_.size())};
    copies_.push_back({body, phase});
  }
  return taken.copy;
}

void HubCopies::finish(std::size_t phases) {
  if (copies_.empty()) return;
  order_.resize(copies_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  const auto key = [&](std::uint32_t k) { return std::tuple{copies_[k].phase, copies_[k].body, k}; };
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t x, std::uint32_t y) { return key(x) < key(y); });
  first_run_.assign(phases + 1, 0);
  for (std::uint32_t at = 0; at < order_.size();) {
    const Copy& copy = copies_[order_[at]];
    std::uint32_t end = at;
    while (end < order_.size() && copies_[order_[end]].phase == copy.phase && copies_[order_[end]].body == copy.body)
      ++end;
    for (std::uint32_t k = at; k < end; ++k) copies_[order_[k]].weight = static_cast<double>(end - at);
    runs_.push_back({copy.body, at, end});
    ++first_run_[copy.phase + 1];
    at = end;
  }
  for (std::size_t p = 1; p < first_run_.size(); ++p) first_run_[p] += first_run_[p - 1];
}

void HubCopies::spread(std::size_t phase, std::span<Body> bodies) const {
  if (copies_.empty()) return;
  for (std::uint32_t r = first_run_[phase]; r < first_run_[phase + 1]; ++r) {
    const Body hub = bodies[runs_[r].body];
    for (std::uint32_t k = runs_[r].first; k < runs_[r].last; ++k) {
      Body& copy = bodies[first_copy_ + order_[k]];
      copy.linear = Lanes{hub.linear[0], hub.linear[1], hub.linear[2], copy.linear[3]};
      copy.angular = Lanes{hub.angular[0], hub.angular[1], hub.angular[2], copy.angular[3]};
    }
  }
}

void HubCopies::collect(std::size_t phase, std::span<Body> bodies) const {
  if (copies_.empty()) return;
  for (std::uint32_t r = first_run_[phase]; r < first_run_[phase + 1]; ++r) {
    Body& hub = bodies[runs_[r].body];
    Lanes linear{}, angular{};
    for (std::uint32_t k = runs_[r].first; k < runs_[r].last; ++k) {
      linear += bodies[first_copy_ + order_[k]].linear - hub.linear;
      angular += bodies[first_copy_ + order_[k]].angular - hub.angular;
    }
    const double share = 1.0 / static_cast<double>(runs_[r].last - runs_[r].first);
    linear *= share, angular *= share;
    linear[3] = angular[3] = 0.0;  // constants of the bodies
    hub.linear += linear;
    hub.angular += angular;
  }
}

}  // namespace scree::sweep
