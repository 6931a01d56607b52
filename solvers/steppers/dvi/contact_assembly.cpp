#include "contact_assembly.hpp"

#include <algorithm>
#include <iterator>

#include "scree/base/release.hpp"
#include "scree/model/material.hpp"
#include "scree/parallel/executor.hpp"
#include "surface_motion.hpp"

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

template <class Property>
bool any_pair(const Materials& materials, const Property& has) {
  for (std::uint32_t a = 0; a < materials.size(); ++a) {
    for (std::uint32_t b = a; b < materials.size(); ++b) {
      if (has(materials.pair(a, b))) return true;
    }
  }
  return false;
}

bool is_compliant(const ContactMaterial& material) { return material.compliance > 0.0; }

const ContactMaterial& pair_of(const BodyView& bodies, const Materials& materials, const Contact& c) {
  return materials.pair(bodies.material[c.a], bodies.material[c.b]);
}

}  // namespace

void ContactAssembly::build(const FreeMotion& motion, std::span<const Contact> contacts, const Materials& materials,
                            const ContactLimits& limits, double dt, const Executor& executor,
                            const JoinedBodies& joined) {
  keep(motion.bodies, contacts);
  order_.build(motion.bodies, contacts_, joined.bodies);
  sort_units(motion.bodies, materials);
  fill_bodies(motion);
  const std::size_t m = contacts_.size();
  const std::size_t joint_rows = joined.problem.rows.size();
  r_.resize(first_row_of_unit(m) + joint_rows);
  compliance_.assign(joint_rows > 0 || any_pair(materials, is_compliant) ? r_.size() : 0, 0.0);
  executor.for_chunks(m, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) fill_unit(motion, materials, limits, dt, i);
  });
  add_joints(joined.problem);
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
  release(unit_of_, inverse_mass_, inverse_inertia_, plain_, rolling_, blocks_, block_rows_, r_, compliance_);
}

// Counting sort by the smaller number of the two bodies, stable; contacts that resist rolling after all others.
void ContactAssembly::sort_units(const BodyView& bodies, const Materials& materials) {
  const std::size_t n = order_.bodies().size(), m = contacts_.size();
  const bool some_roll = any_pair(materials, resists_rolling);
  const auto place = [&](const Contact& c) {
    const std::size_t lower = std::min(order_.number(c.a), order_.number(c.b));
    return some_roll && resists_rolling(pair_of(bodies, materials, c)) ? n + lower : lower;
  };
  cursor_.assign((some_roll ? 2 * n : n) + 1, 0);
  for (const Contact& c : contacts_) ++cursor_[place(c) + 1];
  for (std::size_t k = 1; k < cursor_.size(); ++k) cursor_[k] += cursor_[k - 1];
  const std::size_t plain = cursor_[n];
  plain_.resize(plain);
  rolling_.resize(m - plain);
  blocks_.resize(m - plain);
  block_rows_.resize(RollingContact::kRows * (m - plain));
  unit_of_.resize(m);
  for (std::size_t i = 0; i < m; ++i) unit_of_[i] = cursor_[place(contacts_[i])]++;
  if (m >= kManyRecords) release(cursor_);
}

// After the blocks of rolling contacts.
void ContactAssembly::add_joints(const MachineProblem& joints) {
  const std::size_t first = first_joint_row();
  for (CcpBlock block : joints.blocks) {
    block.first_row += static_cast<std::uint32_t>(RollingContact::kRows * rolling_.size());
    block.a = order_.number(block.a);
    block.b = order_.number(block.b);
    blocks_.push_back(block);
  }
  block_rows_.insert(block_rows_.end(), joints.rows.begin(), joints.rows.end());
  std::ranges::copy(joints.r, r_.begin() + static_cast<std::ptrdiff_t>(first));
  if (joints.rows.empty()) return;
  std::ranges::copy(joints.compliance, compliance_.begin() + static_cast<std::ptrdiff_t>(first));
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

void ContactAssembly::fill_unit(const FreeMotion& motion, const Materials& materials, const ContactLimits& limits,
                                double dt, std::size_t contact) {
  const BodyView& bodies = motion.bodies;
  const Contact& c = contacts_[contact];
  const ContactMaterial& material = pair_of(bodies, materials, c);
  const CcpContact geometry = {c.normal,
                               c.point - bodies.position[c.a],
                               c.point - bodies.position[c.b],
                               material.friction,
                               order_.number(c.a),
                               order_.number(c.b)};
  const Vec3 before = relative_velocity(geometry, {bodies.velocity[c.a], bodies.angular_velocity[c.a]},
                                        {bodies.velocity[c.b], bodies.angular_velocity[c.b]});
  const Vec3 free = relative_velocity(geometry, {motion.velocity[c.a], motion.angular_velocity[c.a]},
                                      {motion.velocity[c.b], motion.angular_velocity[c.b]});
  const NormalRow normal = normal_row(material, limits, c.gap, before.x, free.x, dt);
  const std::size_t unit = unit_of_[contact], row = first_row_of_unit(unit);
  const Vec3 slip = surface_slip(bodies, c, geometry);
  r_[row] = free.x + normal.b;
  r_[row + 1] = free.y + slip.y;
  r_[row + 2] = free.z + slip.z;
  if (!compliance_.empty()) compliance_[row] = normal.compliance;
  if (unit < plain_.size()) {
    plain_[unit] = geometry;
  } else {
    fill_rolling(motion, material, geometry, contact);
  }
}

void ContactAssembly::fill_rolling(const FreeMotion& motion, const ContactMaterial& material,
                                   const CcpContact& geometry, std::size_t contact) {
  const Contact& c = contacts_[contact];
  const std::size_t block = unit_of_[contact] - plain_.size(), first = RollingContact::kRows * block;
  const RollingContact& rolling = rolling_[block] = {geometry, smaller_radius(motion.bodies, c)};
  blocks_[block] = rolling.block(material, static_cast<std::uint32_t>(first));
  rolling.write_rows(std::span{block_rows_}.subspan(first).first<RollingContact::kRows>());
  const auto turning = [&](BodyIndex i) {
    return motion.angular_velocity[i] + surface_motion(motion.bodies, i).angular;
  };
  const Vec3 turn = rolling.rolling_velocity(turning(c.a), turning(c.b));
  const std::size_t row = 3 * plain_.size() + first + 3;
  r_[row] = turn.x;
  r_[row + 1] = turn.y;
  r_[row + 2] = turn.z;
}

}  // namespace scree::dvi
