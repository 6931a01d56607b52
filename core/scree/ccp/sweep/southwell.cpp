#include "scree/ccp/sweep/southwell.hpp"

#include <utility>

#include "scree/base/release.hpp"
#include "scree/ccp/contact_residual.hpp"
#include "scree/ccp/sweep/local_step.hpp"
#include "scree/ccp/sweep/sequence.hpp"

namespace scree {

void Southwell::bind(const DelassusOperator& delassus) {
  delassus_ = &delassus;
  has_neighbours_ = false;
  const CcpProblem& problem = delassus.problem();
  const std::size_t contacts = problem.contacts.size();
  make_room(problem.bodies() + 1, first_);
  make_room(2 * contacts, contacts_);
  make_room(contacts, queue_, waits_);
}

void Southwell::find_neighbours() {
  const CcpProblem& problem = delassus_->problem();
  const auto for_bodies = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < problem.contacts.size(); ++i) {
      for (const std::uint32_t body : {problem.contacts[i].a, problem.contacts[i].b}) {
        if (problem.inverse_mass[body] > 0.0) visit(body, i);
      }
    }
  };
  first_.assign(problem.bodies() + 1, 0);
  for_bodies([&](std::uint32_t body, std::uint32_t) { ++first_[body]; });
  std::uint32_t end = 0;
  for (std::uint32_t& first : first_) end = first += end;
  contacts_.resize(end);
  // From the back: what was the end of a body's contacts becomes their begin.
  for_bodies([&](std::uint32_t body, std::uint32_t i) { contacts_[--first_[body]] = i; });
  has_neighbours_ = true;
}

void Southwell::push(std::uint32_t i) {
  if (waits_[i] != 0) return;
  waits_[i] = 1;
  const std::size_t at = head_ + count_++;
  queue_[at < queue_.size() ? at : at - queue_.size()] = i;
}

// The velocity of a contact that misses the target (judge.hpp).
std::optional<Vec3> Southwell::miss(std::size_t i, const Vec3& g, std::span<const Twist> w, double target) const {
  const CcpProblem& problem = delassus_->problem();
  const CcpContact& c = problem.contacts[i];
  const double trace = delassus_->traces()[i];
  if (!(trace > 0.0)) return std::nullopt;
  Vec3 u = relative_velocity(c, w[c.a], w[c.b]) + load_block(problem.r, i);
  if (!problem.compliance.empty()) u += hadamard(load_block(problem.compliance, i), g);
  const double residual = squared_contact_residual(g, u, c.friction, 3.0 / trace, trace / 3.0);
  return residual > target * target ? std::optional{u} : std::nullopt;
}

// False when too many contacts miss the target.
bool Southwell::collect(std::span<const double> gamma, std::span<const Twist> w, double target) {
  const std::size_t contacts = delassus_->problem().contacts.size();
  const auto few = static_cast<std::size_t>(kFew * static_cast<double>(contacts));
  queue_.resize(contacts);
  waits_.assign(contacts, 0);
  head_ = count_ = 0;
  for (std::uint32_t i = 0; i < contacts; ++i) {
    if (!miss(i, load_block(gamma, i), w, target)) continue;
    if (count_ > few) return false;
    push(i);
  }
  return true;
}

void Southwell::update(std::size_t i, const Vec3& u, std::span<double> gamma, std::span<Twist> w) const {
  const CcpProblem& problem = delassus_->problem();
  const CcpContact& c = problem.contacts[i];
  const sweep::LocalStep step = sweep::block_step(diagonal_block(problem, i), c.friction, 1.0);
  const Vec3 g = load_block(gamma, i);
  const Vec3 moved = g - Vec3{step.normal * u.x, step.tangent * u.y, step.tangent * u.z};
  const Vec3 next = project_cone3(moved, c.friction, step.weights);
  store_block(gamma, i, next);
  Twist a{}, b{};
  add_impulse(c, next - g, a, b);
  for (const auto& [body, impulse] : {std::pair{c.a, a}, std::pair{c.b, b}}) {
    const Twist change = apply_inverse_mass(problem, body, impulse);
    w[body].linear += change.linear;
    w[body].angular += change.angular;
  }
}

Southwell::Outcome Southwell::relax(std::span<double> gamma, std::span<Twist> w, double target, std::size_t budget) {
  if (!collect(gamma, w, target)) return {};
  if (!has_neighbours_) find_neighbours();
  const CcpProblem& problem = delassus_->problem();
  std::size_t visits = 0;
  bool hub_moved = false;
  for (; visits < budget; ++visits) {
    if (count_ == 0) {
      if (!std::exchange(hub_moved, false)) break;
      visits += problem.contacts.size();
      if (!collect(gamma, w, target)) return {false, visits};
      if (count_ == 0) break;
    }
    const std::uint32_t i = queue_[head_];
    head_ = head_ + 1 < queue_.size() ? head_ + 1 : 0;
    --count_;
    waits_[i] = 0;
    const std::optional<Vec3> u = miss(i, load_block(gamma, i), w, target);
    if (!u) continue;
    update(i, *u, gamma, w);
    const CcpContact& c = problem.contacts[i];
    for (const std::uint32_t body : {c.a, c.b}) {
      const bool hub = first_[body + 1] - first_[body] > sweep::Sequence::kHub;
      hub_moved = hub_moved || hub;
      for (std::uint32_t k = first_[body]; k < first_[body + 1] && !hub; ++k) push(contacts_[k]);
    }
  }
  return {count_ == 0 && !hub_moved, visits};
}

}  // namespace scree
