#include "scree/ccp/sweep/contact_sweep.hpp"

#include <algorithm>

#include "scree/ccp/delassus.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree {
namespace {

void put(Lanes3& lanes, int k, const Vec3& v) { lanes.x[k] = v.x, lanes.y[k] = v.y, lanes.z[k] = v.z; }

sweep::LocalStep step_of(const CcpProblem& problem, std::size_t i, const ContactSweep::Settings& settings) {
  const Mat3 block = diagonal_block(problem, i);
  const double friction = problem.contacts[i].friction;
  return settings.scalar_step ? sweep::scalar_step(block, friction, settings.relaxation)
                              : sweep::block_step(block, friction, settings.relaxation);
}

}  // namespace

void ContactSweep::bind(const CcpProblem& problem, const Settings& settings) {
  coloured_ = settings.coloured;
  coloured_ ? sequence_.build_chunks(problem, sweep::Colouring::kChunkLength) : sequence_.build_whole(problem);
  grouping_.build(problem, sequence_);
  if (coloured_) colouring_.build(problem, sequence_);
  bind_bodies(problem);
  bind_groups(problem, settings);
}

void ContactSweep::bind_bodies(const CcpProblem& problem) {
  const std::size_t n = problem.bodies(), nothings = std::max<std::size_t>(1, chunks());
  const auto is_isotropic = [](const Mat3& j) { return j == Mat3::diagonal({j.row0.x, j.row0.x, j.row0.x}); };
  const bool isotropic = std::all_of(problem.inverse_inertia.begin(), problem.inverse_inertia.end(), is_isotropic);
  bodies_.assign(n + nothings, sweep::Body{});
  inertias_.assign(isotropic ? 0 : n + nothings, sweep::Inertia{});
  for (std::size_t k = 0; k < n; ++k) {
    const Mat3& j = problem.inverse_inertia[k];
    bodies_[k].linear[3] = problem.inverse_mass[k];
    if (isotropic) {
      bodies_[k].angular[3] = j.row0.x;
      continue;
    }
    inertias_[k].column[0] = Lanes{j.row0.x, j.row1.x, j.row2.x, 0.0};
    inertias_[k].column[1] = Lanes{j.row0.y, j.row1.y, j.row2.y, 0.0};
    inertias_[k].column[2] = Lanes{j.row0.z, j.row1.z, j.row2.z, 0.0};
  }
}

void ContactSweep::bind_groups(const CcpProblem& problem, const Settings& settings) {
  groups_.assign(grouping_.groups.size(), sweep::Group{});
  compliance_.assign(problem.compliance.empty() ? 0 : groups_.size(), Lanes3{});
  for (std::size_t chunk = 0; chunk < chunks(); ++chunk) {
    const auto nothing = static_cast<std::uint32_t>(problem.bodies() + chunk);
    for (std::size_t at = grouping_.first[chunk]; at < grouping_.first[chunk + 1]; ++at) {
      groups_[at].a.fill(nothing);
      groups_[at].b.fill(nothing);
      for (int k = 0; k < 4; ++k) {
        const std::uint32_t i = grouping_.groups[at][static_cast<std::size_t>(k)];
        if (i != sweep::kNoContact) put_contact(problem, at, k, i, step_of(problem, i, settings));
      }
    }
  }
}

void ContactSweep::put_contact(const CcpProblem& problem, std::size_t at, int lane, std::size_t i,
                               const sweep::LocalStep& step) {
  const CcpContact& c = problem.contacts[i];
  const auto k = static_cast<std::size_t>(lane);
  sweep::Group& group = groups_[at];
  put(group.normal, lane, c.normal);
  put(group.tangent1, lane, contact_frame(c.normal).tangent1);
  put(group.arm_a, lane, c.arm_a);
  put(group.arm_b, lane, c.arm_b);
  put(group.r, lane, load_block(problem.r, i));
  group.step_n[lane] = step.normal, group.step_t[lane] = step.tangent;
  group.along[lane] = step.weights.along, group.across[lane] = step.weights.across, group.friction[lane] = c.friction;
  // Immovable bodies stay with the one that stands for nothing.
  if (problem.inverse_mass[c.a] > 0.0) group.a[k] = c.a;
  if (problem.inverse_mass[c.b] > 0.0) group.b[k] = c.b;
  if (!problem.compliance.empty()) put(compliance_[at], lane, load_block(problem.compliance, i));
}

void ContactSweep::set_impulses(std::span<const double> gamma) {
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t i = grouping_.groups[at][static_cast<std::size_t>(k)];
      if (i != sweep::kNoContact) put(groups_[at].g, k, load_block(gamma, i));
    }
  }
}

void ContactSweep::impulses(std::span<double> gamma) const {
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    const Lanes3& g = groups_[at].g;
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t i = grouping_.groups[at][static_cast<std::size_t>(k)];
      if (i != sweep::kNoContact) store_block(gamma, i, {g.x[k], g.y[k], g.z[k]});
    }
  }
}

void ContactSweep::set_velocities(std::span<const Twist> w) {
  for (std::size_t k = 0; k < w.size(); ++k) {
    const auto& [v, omega] = w[k];
    sweep::Body& body = bodies_[k];
    body.linear = Lanes{v.x, v.y, v.z, body.linear[3]};
    body.angular = Lanes{omega.x, omega.y, omega.z, body.angular[3]};
  }
}

void ContactSweep::velocities(std::span<Twist> w) const {
  for (std::size_t k = 0; k < w.size(); ++k) {
    const sweep::Body& body = bodies_[k];
    w[k] = {{body.linear[0], body.linear[1], body.linear[2]}, {body.angular[0], body.angular[1], body.angular[2]}};
  }
}

}  // namespace scree
