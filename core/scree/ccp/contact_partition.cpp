#include "scree/ccp/contact_partition.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "scree/base/release.hpp"

namespace scree {

namespace {
constexpr std::uint32_t kNoRun = std::numeric_limits<std::uint32_t>::max();
}

void ContactPartition::build(const CcpProblem& problem) {
  const std::size_t n = problem.bodies();
  const std::size_t m = problem.matrix.empty() ? problem.units() : 0;
  const std::size_t contacts = problem.contacts.size();
  const auto bodies_of = [&](std::size_t unit) {
    if (unit < contacts) return std::array{problem.contacts[unit].a, problem.contacts[unit].b};
    return std::array{problem.blocks[unit - contacts].a, problem.blocks[unit - contacts].b};
  };
  const auto movable = [&](std::uint32_t body) { return problem.inverse_mass[body] > 0.0; };
  make_room(m, slots_);
  make_room(n + 1, first_slot_, last_run_, current_slot_);
  slots_.resize(m);
  first_slot_.assign(n + 1, 0);
  last_run_.assign(n, kNoRun);
  current_slot_.resize(n);

  // Count the runs that touch each body, then number the slots body by body.
  for (std::size_t i = 0; i < m; ++i) {
    const auto run = static_cast<std::uint32_t>(i / kRunLength);
    for (const std::uint32_t body : bodies_of(i)) {
      if (!movable(body) || last_run_[body] == run) continue;
      last_run_[body] = run;
      ++first_slot_[body + 1];
    }
  }
  for (std::size_t k = 0; k < n; ++k) first_slot_[k + 1] += first_slot_[k];
  const std::uint32_t sink = first_slot_[n];
  slot_count_ = sink + (m + kRunLength - 1) / kRunLength;

  std::fill(last_run_.begin(), last_run_.end(), kNoRun);
  const auto slot_of = [&](std::uint32_t body, std::uint32_t run) {
    if (!movable(body)) return sink + run;
    if (last_run_[body] != run) {
      current_slot_[body] = last_run_[body] == kNoRun ? first_slot_[body] : current_slot_[body] + 1;
      last_run_[body] = run;
    }
    return current_slot_[body];
  };
  for (std::size_t i = 0; i < m; ++i) {
    const auto run = static_cast<std::uint32_t>(i / kRunLength);
    const auto [a, b] = bodies_of(i);
    slots_[i].a = slot_of(a, run);
    slots_[i].b = slot_of(b, run);
  }
  if (m >= kManyRecords) release(last_run_, current_slot_);
}

}  // namespace scree
