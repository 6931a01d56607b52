#include "scree/ccp/sweep/contact_sweep.hpp"

#include <algorithm>

#include "scree/ccp/cone3.hpp"
#include "scree/ccp/delassus.hpp"

namespace scree {
namespace {

void put(Lanes3& lanes, int k, const Vec3& v) { lanes.x[k] = v.x, lanes.y[k] = v.y, lanes.z[k] = v.z; }

/// Both arms lie along the normal, but for what rounding leaves of the difference of two positions.
bool is_central(const CcpContact& c) {
  constexpr double kRounding = 1e-11;
  const auto lies = [&](const Vec3& arm) {
    const double along = dot(arm, c.normal);
    return squared_norm(arm - along * c.normal) <= kRounding * kRounding * along * along;
  };
  return lies(c.arm_a) && lies(c.arm_b);
}

}  // namespace

void ContactSweep::bind(const CcpProblem& problem, const Settings& settings) {
  coloured_ = settings.coloured;
  grouping_.build(problem,
                  coloured_ ? sweep::Colouring::kChunkLength : std::max<std::size_t>(1, problem.contacts.size()));
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
  const auto prepare = [&](auto& groups, bool used) {
    groups.clear();
    if (!used) return;
    groups.resize(grouping_.groups.size());
    for (auto& group : groups) group.a.fill(nothing), group.b.fill(nothing);
  };
  contacts_ = problem.contacts;
  spherical_ = isotropic() && problem.compliance.empty() && std::all_of(contacts_.begin(), contacts_.end(), is_central);
  prepare(groups_, !spherical_);
  prepare(spheres_, spherical_);
  compliance_.assign(problem.compliance.empty() ? 0 : groups_.size(), Lanes3{});
  for (std::size_t at = 0; at < grouping_.groups.size(); ++at) {
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t i = grouping_.groups[at][static_cast<std::size_t>(k)];
      if (i == sweep::kNoContact) continue;
      const Mat3 block = diagonal_block(problem, i);
      const double friction = contacts_[i].friction;
      put_contact(problem, at, k, i,
                  settings.scalar_step ? sweep::scalar_step(block, friction, settings.relaxation)
                                       : sweep::block_step(block, friction, settings.relaxation));
    }
  }
}

void ContactSweep::put_contact(const CcpProblem& problem, std::size_t at, int lane, std::size_t i,
                               const sweep::LocalStep& step) {
  const CcpContact& c = contacts_[i];
  const Vec3 r = load_block(problem.r, i);
  const auto k = static_cast<std::size_t>(lane);
  if (spherical_) {
    sweep::SphereGroup& group = spheres_[at];
    put(group.normal, lane, c.normal);
    put(group.r, lane, in_world(c, r));
    group.arm_a[lane] = dot(c.arm_a, c.normal), group.arm_b[lane] = dot(c.arm_b, c.normal);
    group.step_n[lane] = step.normal, group.step_t[lane] = step.tangent, group.friction[lane] = c.friction;
    group.a[k] = c.a, group.b[k] = c.b;
    return;
  }
  sweep::Group& group = groups_[at];
  put(group.normal, lane, c.normal);
  put(group.tangent1, lane, c.tangent1);
  put(group.arm_a, lane, c.arm_a);
  put(group.arm_b, lane, c.arm_b);
  put(group.r, lane, r);
  group.step_n[lane] = step.normal, group.step_t[lane] = step.tangent;
  group.along[lane] = step.weights.along, group.across[lane] = step.weights.across, group.friction[lane] = c.friction;
  group.a[k] = c.a, group.b[k] = c.b;
  if (!problem.compliance.empty()) put(compliance_[at], lane, load_block(problem.compliance, i));
}

const std::array<std::uint32_t, 4>& ContactSweep::first_bodies(std::size_t k) const {
  return spherical_ ? spheres_[k].a : groups_[k].a;
}
const std::array<std::uint32_t, 4>& ContactSweep::second_bodies(std::size_t k) const {
  return spherical_ ? spheres_[k].b : groups_[k].b;
}

void ContactSweep::set_impulses(std::span<const double> gamma) {
  for (std::size_t at = 0; at < grouping_.groups.size(); ++at) {
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t i = grouping_.groups[at][static_cast<std::size_t>(k)];
      if (i == sweep::kNoContact) continue;
      const Vec3 g = load_block(gamma, i);
      spherical_ ? put(spheres_[at].g, k, in_world(contacts_[i], g)) : put(groups_[at].g, k, g);
    }
  }
}

void ContactSweep::impulses(std::span<double> gamma) const {
  for (std::size_t at = 0; at < grouping_.groups.size(); ++at) {
    const Lanes3& g = spherical_ ? spheres_[at].g : groups_[at].g;
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t i = grouping_.groups[at][static_cast<std::size_t>(k)];
      if (i == sweep::kNoContact) continue;
      const Vec3 one{g.x[k], g.y[k], g.z[k]};
      // Turning may put an impulse on the surface of its cone outside by rounding.
      store_block(gamma, i, spherical_ ? project_cone3(in_frame(contacts_[i], one), contacts_[i].friction) : one);
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
