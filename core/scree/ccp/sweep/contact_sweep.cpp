#include "scree/ccp/sweep/contact_sweep.hpp"

#include <algorithm>

#include "scree/ccp/delassus.hpp"

namespace scree {
namespace {

void put(Lanes3& lanes, int k, const Vec3& v) { lanes.x[k] = v.x, lanes.y[k] = v.y, lanes.z[k] = v.z; }

}  // namespace

void ContactSweep::bind(const CcpProblem& problem, const Settings& settings) {
  coloured_ = settings.coloured;
  grouping_.build(problem, coloured_ ? sweep::Colouring::kChunkLength : std::max<std::size_t>(1, problem.contacts.size()));
  if (coloured_) colouring_.build(problem);
  bind_bodies(problem);
  bind_groups(problem, settings);
}

void ContactSweep::bind_bodies(const CcpProblem& problem) {
  const std::size_t n = problem.bodies();
  const auto is_isotropic = [](const Mat3& j) { return j == Mat3::diagonal({j.row0.x, j.row0.x, j.row0.x}); };
  const bool isotropic = std::all_of(problem.inverse_inertia.begin(), problem.inverse_inertia.end(), is_isotropic);
  bodies_.assign(n + 1, sweep::Body{});
  inertias_.assign(isotropic ? 0 : n + 1, sweep::Inertia{});
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
  const auto nothing = static_cast<std::uint32_t>(problem.bodies());
  groups_.resize(grouping_.groups.size());
  compliance_.assign(problem.compliance.empty() ? 0 : groups_.size(), Lanes3{});
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    sweep::Group& group = groups_[at];
    group = sweep::Group{};
    group.a.fill(nothing);
    group.b.fill(nothing);
    for (int k = 0; k < 4; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      const std::uint32_t i = grouping_.groups[at][lane];
      if (i == sweep::kNoContact) continue;
      const CcpContact& c = problem.contacts[i];
      const Mat3 block = diagonal_block(problem, i);
      const sweep::LocalStep step = settings.scalar_step ? sweep::scalar_step(block, c.friction, settings.relaxation)
                                                         : sweep::block_step(block, c.friction, settings.relaxation);
      put(group.normal, k, c.normal);
      put(group.tangent1, k, c.tangent1);
      put(group.arm_a, k, c.arm_a);
      put(group.arm_b, k, c.arm_b);
      put(group.r, k, load_block(problem.r, i));
      group.step_n[k] = step.normal, group.step_t[k] = step.tangent;
      group.along[k] = step.weights.along, group.across[k] = step.weights.across, group.friction[k] = c.friction;
      group.a[lane] = c.a, group.b[lane] = c.b;
      if (!problem.compliance.empty()) put(compliance_[at], k, load_block(problem.compliance, i));
    }
  }
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
