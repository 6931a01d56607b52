#include "contact_assembly.hpp"

#include <algorithm>
#include <iterator>

#include "scree/base/release.hpp"
#include "scree/model/material.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::dvi {

namespace {

constexpr std::size_t kGrain = 1024;

// Isotropic bodies are left unrotated: cheaper, and their inertia is then exactly isotropic.
Mat3 world_inverse_inertia(const BodyView& bodies, BodyIndex i) {
  const Vec3 j = bodies.inertia[i];
  const bool isotropic = j.x == j.y && j.y == j.z;
  if (isotropic && bodies.motion[i] == Motion::dynamic) return Mat3::diagonal({1.0 / j.x, 1.0 / j.x, 1.0 / j.x});
  return inverse_inertia(bodies, i);
}

/// b_n [m/s] and E_n [1/kg] of a contact.
struct NormalRow {
  double b = 0.0;
  double compliance = 0.0;
};

// `before` and `free`: u_n of v0 and of v_f.
NormalRow normal_row(const ContactMaterial& material, const ContactLimits& limits, double gap, double before,
                     double free, double h) {
  if (material.compliance > 0.0) {
    const double k = 1.0 / material.compliance;
    const double sum = h * k + material.damping;
    return {k / sum * gap, 1.0 / (h * sum)};
  }
  double b = gap > 0.0 ? gap / h : std::max(gap / h, -limits.recovery_speed);
  const bool impact = before < -limits.min_bounce_speed && gap + h * free <= 0.0;
  if (impact) b = std::min(b, material.restitution * before);
  return {b, 0.0};
}

bool any_compliance(const Materials& materials) {
  for (std::uint32_t a = 0; a < materials.size(); ++a) {
    for (std::uint32_t b = a; b < materials.size(); ++b) {
      if (materials.pair(a, b).compliance > 0.0) return true;
    }
  }
  return false;
}

}  // namespace

void ContactAssembly::build(const FreeMotion& motion, std::span<const Contact> contacts, const Materials& materials,
                            const ContactLimits& limits, double dt, const Executor& executor) {
  keep(motion.bodies, contacts);
  order_.build(motion.bodies, contacts_);
  sort_blocks();
  fill_bodies(motion);
  const std::size_t m = contacts_.size();
  blocks_.resize(m);
  r_.resize(3 * m);
  compliance_.assign(any_compliance(materials) ? 3 * m : 0, 0.0);
  executor.for_chunks(m, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) fill_block(motion, materials, limits, dt, i);
  });
  if (std::all_of(compliance_.begin(), compliance_.end(), [](double e) { return e == 0.0; })) compliance_.clear();
}

void ContactAssembly::keep(const BodyView& bodies, std::span<const Contact> contacts) {
  const auto moves = [&](const Contact& c) {
    return bodies.motion[c.a] == Motion::dynamic || bodies.motion[c.b] == Motion::dynamic;
  };
  kept_.clear();
  contacts_ = contacts;
  if (std::all_of(contacts.begin(), contacts.end(), moves)) return;
  std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(kept_), moves);
  contacts_ = kept_;
}

void ContactAssembly::release_problem() {
  order_ = {};
  release(block_of_, cursor_, inverse_mass_, inverse_inertia_, blocks_, r_, compliance_);
}

// Counting sort by the smaller number of the two bodies, stable.
void ContactAssembly::sort_blocks() {
  const auto lower = [&](const Contact& c) { return std::min(order_.number(c.a), order_.number(c.b)); };
  cursor_.assign(order_.bodies().size() + 1, 0);
  for (const Contact& c : contacts_) ++cursor_[lower(c) + 1];
  for (std::size_t k = 1; k < cursor_.size(); ++k) cursor_[k] += cursor_[k - 1];
  block_of_.resize(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) block_of_[i] = cursor_[lower(contacts_[i])]++;
}

void ContactAssembly::fill_bodies(const FreeMotion& motion) {
  const std::span<const BodyIndex> bodies = order_.bodies();
  inverse_mass_.resize(bodies.size());
  inverse_inertia_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    inverse_mass_[k] = inverse_mass(motion.bodies, bodies[k]);
    inverse_inertia_[k] = world_inverse_inertia(motion.bodies, bodies[k]);
  }
}

void ContactAssembly::fill_block(const FreeMotion& motion, const Materials& materials, const ContactLimits& limits,
                                 double dt, std::size_t contact) {
  const BodyView& bodies = motion.bodies;
  const Contact& c = contacts_[contact];
  const ContactMaterial& material = materials.pair(bodies.material[c.a], bodies.material[c.b]);
  const std::size_t i = block_of_[contact];
  CcpContact& block = blocks_[i];
  block = {c.normal,
           contact_frame(c.normal).tangent1,
           c.point - bodies.position[c.a],
           c.point - bodies.position[c.b],
           material.friction,
           order_.number(c.a),
           order_.number(c.b)};
  const Vec3 before = relative_velocity(block, {bodies.velocity[c.a], bodies.angular_velocity[c.a]},
                                        {bodies.velocity[c.b], bodies.angular_velocity[c.b]});
  const Vec3 free = relative_velocity(block, {motion.velocity[c.a], motion.angular_velocity[c.a]},
                                      {motion.velocity[c.b], motion.angular_velocity[c.b]});
  const NormalRow row = normal_row(material, limits, c.gap, before.x, free.x, dt);
  store_block(r_, i, free + Vec3{row.b, 0.0, 0.0});
  if (!compliance_.empty()) compliance_[3 * i] = row.compliance;
}

}  // namespace scree::dvi
