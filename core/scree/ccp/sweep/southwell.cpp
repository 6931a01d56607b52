#include "scree/ccp/sweep/southwell.hpp"

#include <array>
#include <utility>

#include "scree/base/release.hpp"
#include "scree/ccp/block_rows.hpp"
#include "scree/ccp/contact_residual.hpp"
#include "scree/ccp/judge.hpp"
#include "scree/ccp/sweep/local_step.hpp"
#include "scree/ccp/sweep/sequence.hpp"

namespace scree {

void Southwell::bind(const DelassusOperator& delassus) {
  delassus_ = &delassus;
  has_neighbours_ = false;
  const CcpProblem& problem = delassus.problem();
  const std::size_t units = problem.units();
  make_room(problem.bodies() + 1, first_);
  make_room(2 * units, units_);
  make_room(units, queue_, waits_);
}

void Southwell::find_neighbours() {
  const CcpProblem& problem = delassus_->problem();
  const auto for_bodies = [&](const auto& visit) {
    const auto go = [&](std::uint32_t unit, std::uint32_t a, std::uint32_t b) {
      if (problem.inverse_mass[a] > 0.0) visit(a, unit);
      if (a != b && problem.inverse_mass[b] > 0.0) visit(b, unit);
    };
    std::uint32_t unit = 0;
    for (const CcpContact& contact : problem.contacts) go(unit++, contact.a, contact.b);
    for (const CcpBlock& block : problem.blocks) go(unit++, block.a, block.b);
  };
  first_.assign(problem.bodies() + 1, 0);
  for_bodies([&](std::uint32_t body, std::uint32_t) { ++first_[body]; });
  std::uint32_t end = 0;
  for (std::uint32_t& first : first_) end = first += end;
  units_.resize(end);
  // From the back: what was the end of a body's units becomes their begin, and blocks come first.
  for_bodies([&](std::uint32_t body, std::uint32_t unit) { units_[--first_[body]] = unit; });
  steps_.bind(problem, {});
  has_neighbours_ = true;
}

void Southwell::push(std::uint32_t unit) {
  if (waits_[unit] != 0) return;
  waits_[unit] = 1;
  const std::size_t at = head_ + count_++;
  queue_[at < queue_.size() ? at : at - queue_.size()] = unit;
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

// The same of a block.
std::optional<BlockVector> Southwell::miss_of_block(std::size_t block, std::span<const double> gamma,
                                                    std::span<const Twist> w, double target) const {
  const CcpProblem& problem = delassus_->problem();
  const CcpBlock& b = problem.blocks[block];
  const double trace = delassus_->traces()[problem.contacts.size() + block];
  if (!(trace > 0.0)) return std::nullopt;
  BlockVector u{};
  delassus_->block_velocity(block, w, gamma, u);
  const std::span<const double> r = rows_of(problem, b, problem.r);
  for (std::size_t k = 0; k < b.rows; ++k) u[k] += r[k];
  const double residual = squared_block_residual(b, rows_of(problem, b, gamma), {u.data(), b.rows}, trace);
  return residual > target * target ? std::optional{u} : std::nullopt;
}

bool Southwell::misses(std::size_t unit, std::span<const double> gamma, std::span<const Twist> w, double target) const {
  const std::size_t contacts = delassus_->problem().contacts.size();
  return unit < contacts ? miss(unit, load_block(gamma, unit), w, target).has_value()
                         : miss_of_block(unit - contacts, gamma, w, target).has_value();
}

// False when too many units miss the target.
bool Southwell::collect(std::span<const double> gamma, std::span<const Twist> w, double target) {
  const std::size_t units = delassus_->problem().units();
  const auto few = static_cast<std::size_t>(kFew * static_cast<double>(units));
  queue_.resize(units);
  waits_.assign(units, 0);
  head_ = count_ = 0;
  for (std::uint32_t unit = 0; unit < units; ++unit) {
    if (!misses(unit, gamma, w, target)) continue;
    if (count_ > few) return false;
    push(unit);
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

void Southwell::update_block(std::size_t block, const BlockVector& u, std::span<double> gamma,
                             std::span<Twist> w) const {
  const CcpProblem& problem = delassus_->problem();
  const CcpBlock& b = problem.blocks[block];
  const std::span<double> g = rows_of(problem, b, gamma);
  BlockVector change{};
  for (std::size_t k = 0; k < b.rows; ++k) change[k] = -g[k];
  steps_.advance(block, {u.data(), b.rows}, g);
  for (std::size_t k = 0; k < b.rows; ++k) change[k] += g[k];
  Twist on_a{}, on_b{};
  add_impulse(jacobian_of(problem, b), {change.data(), b.rows}, on_a, on_b);
  for (const auto& [body, impulse] : {std::pair{b.a, on_a}, std::pair{b.b, on_b}}) {
    const Twist more = apply_inverse_mass(problem, body, impulse);
    w[body].linear += more.linear;
    w[body].angular += more.angular;
  }
}

// Updates a unit that misses the target; false when it does not.
bool Southwell::visit(std::size_t unit, std::span<double> gamma, std::span<Twist> w, double target) const {
  const std::size_t contacts = delassus_->problem().contacts.size();
  if (unit < contacts) {
    const std::optional<Vec3> u = miss(unit, load_block(gamma, unit), w, target);
    if (u) update(unit, *u, gamma, w);
    return u.has_value();
  }
  const std::optional<BlockVector> u = miss_of_block(unit - contacts, gamma, w, target);
  if (u) update_block(unit - contacts, *u, gamma, w);
  return u.has_value();
}

// The units that share a body with this one; of a hub its blocks only. True when a hub is among the bodies.
bool Southwell::push_neighbours(std::size_t unit) {
  const CcpProblem& problem = delassus_->problem();
  const std::size_t contacts = problem.contacts.size();
  const auto bodies = unit < contacts
                          ? std::array{problem.contacts[unit].a, problem.contacts[unit].b}
                          : std::array{problem.blocks[unit - contacts].a, problem.blocks[unit - contacts].b};
  bool any_hub = false;
  for (const std::uint32_t body : bodies) {
    const bool hub = first_[body + 1] - first_[body] > sweep::Sequence::kHub;
    any_hub = any_hub || hub;
    for (std::uint32_t k = first_[body]; k < first_[body + 1] && !(hub && units_[k] < contacts); ++k) push(units_[k]);
  }
  return any_hub;
}

Southwell::Outcome Southwell::relax(std::span<double> gamma, std::span<Twist> w, double target, std::size_t budget) {
  if (!collect(gamma, w, target)) return {};
  if (!has_neighbours_) find_neighbours();
  std::size_t visits = 0;
  bool hub_moved = false;
  for (; visits < budget; ++visits) {
    if (count_ == 0) {
      if (!std::exchange(hub_moved, false)) break;
      visits += delassus_->problem().units();
      if (!collect(gamma, w, target)) return {false, visits};
      if (count_ == 0) break;
    }
    const std::uint32_t unit = queue_[head_];
    head_ = head_ + 1 < queue_.size() ? head_ + 1 : 0;
    --count_;
    waits_[unit] = 0;
    if (visit(unit, gamma, w, target)) hub_moved = push_neighbours(unit) || hub_moved;
  }
  return {count_ == 0 && !hub_moved, visits};
}

}  // namespace scree
