#include "scree/ccp/sweep/sequence.hpp"

#include <algorithm>

namespace scree::sweep {

void Sequence::split(const CcpProblem& problem) {
  degree_.assign(problem.bodies(), 0);
  for (const CcpContact& c : problem.contacts) {
    for (const std::uint32_t body : {c.a, c.b}) degree_[body] += problem.inverse_mass[body] > 0.0 ? 1 : 0;
  }
  contacts_.clear();
  hub_contacts_.clear();
  contacts_.reserve(problem.contacts.size());
  for (std::uint32_t i = 0; i < problem.contacts.size(); ++i) {
    const CcpContact& c = problem.contacts[i];
    (std::max(degree_[c.a], degree_[c.b]) > kHub ? hub_contacts_ : contacts_).push_back(i);
  }
}

void Sequence::cut(std::size_t begin, std::size_t end, std::size_t length) {
  for (std::size_t at = begin; at < end; at += length) {
    first_.push_back(static_cast<std::uint32_t>(std::min(at + length, end)));
  }
}

void Sequence::build_whole(const CcpProblem& problem) {
  split(problem);
  if (!hub_contacts_.empty()) {
    merged_.clear();
    merged_.reserve(problem.contacts.size());
    const std::size_t hubs = hub_contacts_.size(), others = contacts_.size();
    for (std::size_t k = 0, next = 0; k < hubs; ++k) {
      for (; next * hubs < (k + 1) * others; ++next) merged_.push_back(contacts_[next]);
      merged_.push_back(hub_contacts_[k]);
    }
    contacts_.swap(merged_);
  }
  first_.assign(1, 0);
  if (!contacts_.empty()) cut(0, contacts_.size(), contacts_.size());
  ordinary_chunks_ = chunks();
}

void Sequence::build_chunks(const CcpProblem& problem, std::size_t length) {
  split(problem);
  const std::size_t ordinary = contacts_.size();
  contacts_.insert(contacts_.end(), hub_contacts_.begin(), hub_contacts_.end());
  first_.assign(1, 0);
  cut(0, ordinary, length);
  ordinary_chunks_ = chunks();
  cut(ordinary, contacts_.size(), length);
}

}  // namespace scree::sweep
