#include "scree/ccp/sweep/sequence.hpp"

#include <algorithm>
#include <numeric>

namespace scree::sweep {

void Sequence::count(const CcpProblem& problem) {
  degree_.assign(problem.bodies(), 0);
  for (const CcpContact& c : problem.contacts) {
    for (const std::uint32_t body : {c.a, c.b}) degree_[body] += problem.inverse_mass[body] > 0.0 ? 1 : 0;
  }
  contacts_.resize(problem.contacts.size());
  std::iota(contacts_.begin(), contacts_.end(), 0U);
  hubs_ = 0;
}

void Sequence::cut(std::size_t length) {
  first_.assign(1, 0);
  for (std::size_t at = 0; at < contacts_.size(); at += length) {
    first_.push_back(static_cast<std::uint32_t>(std::min(at + length, contacts_.size())));
  }
}

void Sequence::build_spread(const CcpProblem& problem) {
  count(problem);
  const auto of_hub = [&](std::uint32_t i) {
    const CcpContact& c = problem.contacts[i];
    return std::max(degree_[c.a], degree_[c.b]) > kHub;
  };
  hub_contacts_.clear();
  std::copy_if(contacts_.begin(), contacts_.end(), std::back_inserter(hub_contacts_), of_hub);
  if (!hub_contacts_.empty()) {
    contacts_.erase(std::remove_if(contacts_.begin(), contacts_.end(), of_hub), contacts_.end());
    merged_.clear();
    merged_.reserve(problem.contacts.size());
    const std::size_t hubs = hub_contacts_.size(), others = contacts_.size();
    for (std::size_t k = 0, next = 0; k < hubs; ++k) {
      for (; next * hubs < (k + 1) * others; ++next) merged_.push_back(contacts_[next]);
      merged_.push_back(hub_contacts_[k]);
    }
    contacts_.swap(merged_);
  }
  cut(std::max<std::size_t>(1, contacts_.size()));
}

void Sequence::build_split(const CcpProblem& problem, std::size_t length) {
  count(problem);
  if (std::any_of(degree_.begin(), degree_.end(), [](std::uint32_t degree) { return degree > kHub; })) {
    rank_.assign(problem.bodies(), kNoHub);
    for (std::size_t body = 0; body < degree_.size(); ++body) {
      if (degree_[body] > kHub) rank_[body] = static_cast<std::uint32_t>(hubs_++);
    }
    sort_by_partner(problem);
  }
  cut(length > 0 ? length : std::max<std::size_t>(1, contacts_.size()));
}

// Counting sort by the smaller of the bodies that move and are no hubs, stable.
void Sequence::sort_by_partner(const CcpProblem& problem) {
  const auto n = static_cast<std::uint32_t>(problem.bodies());
  const auto place = [&](std::uint32_t body) {
    return problem.inverse_mass[body] > 0.0 && rank_[body] == kNoHub ? body : n;
  };
  const auto key = [&](std::uint32_t i) {
    const CcpContact& c = problem.contacts[i];
    return std::min(place(c.a), place(c.b));
  };
  cursor_.assign(std::size_t{n} + 2, 0);
  for (const std::uint32_t i : contacts_) ++cursor_[key(i) + 1];
  for (std::size_t k = 1; k < cursor_.size(); ++k) cursor_[k] += cursor_[k - 1];
  merged_.resize(contacts_.size());
  for (const std::uint32_t i : contacts_) merged_[cursor_[key(i)]++] = i;
  contacts_.swap(merged_);
}

}  // namespace scree::sweep
