#include "scree/ccp/sweep/contact_sweep.hpp"

#include <algorithm>
#include <array>

#include "scree/ccp/delassus.hpp"
#include "scree/math/contact_frame.hpp"

namespace scree {
namespace {

void put(Lanes3& lanes, int k, const Vec3& v) { lanes.x[k] = v.x, lanes.y[k] = v.y, lanes.z[k] = v.z; }

Mat3 times(double c, const Mat3& m) { return {c * m.row0, c * m.row1, c * m.row2}; }

/// The block of contact i if its bodies were so many times lighter.
Mat3 lighter_block(const CcpProblem& problem, std::size_t i, double lighter_a, double lighter_b) {
  if (lighter_a == 1.0 && lighter_b == 1.0) return diagonal_block(problem, i);
  CcpContact c = problem.contacts[i];
  const std::array mass{lighter_a * problem.inverse_mass[c.a], lighter_b * problem.inverse_mass[c.b]};
  const std::array inertia{times(lighter_a, problem.inverse_inertia[c.a]),
                           times(lighter_b, problem.inverse_inertia[c.b])};
  c.a = 0, c.b = 1;
  const bool compliant = !problem.compliance.empty();
  return diagonal_block({.inverse_mass = mass,
                         .inverse_inertia = inertia,
                         .contacts = {&c, 1},
                         .r = problem.r.subspan(3 * i, 3),
                         .compliance = compliant ? problem.compliance.subspan(3 * i, 3) : problem.compliance},
                        0);
}

sweep::LocalStep step_of(const Mat3& block, const CcpProblem& problem, std::size_t i,
                         const ContactSweep::Settings& settings) {
  const double friction = problem.contacts[i].friction;
  return settings.scalar_step ? sweep::scalar_step(block, friction, settings.relaxation)
                              : sweep::block_step(block, friction, settings.relaxation);
}

}  // namespace

void ContactSweep::bind(const CcpProblem& problem, const Settings& settings) {
  coloured_ = settings.coloured;
  sequence_.build_split(problem, coloured_ ? sweep::Colouring::kChunkLength : 0);
  grouping_.build(problem, sequence_);
  if (coloured_) colouring_.build(problem, sequence_);
  choose_bodies(problem);
  bind_bodies(problem);
  bind_groups(problem, settings);
}

// The bodies of each lane. Immovable ones, and those of empty lanes, are the one that stands for nothing.
void ContactSweep::choose_bodies(const CcpProblem& problem) {
  groups_.assign(grouping_.groups.size(), sweep::Group{});
  const std::size_t n = problem.bodies(), nothings = std::max<std::size_t>(1, chunks());
  copies_.start(sequence_, 4, static_cast<std::uint32_t>(n + nothings));
  std::vector<std::uint32_t> phase(chunks(), 0);
  for (std::size_t p = 0; coloured_ && p < phases(); ++p) {
    for (std::size_t k = first_of_phase(p); k < first_of_phase(p + 1); ++k) {
      phase[colouring_.chunks()[k]] = static_cast<std::uint32_t>(p);
    }
  }
  for (std::uint32_t chunk = 0; chunk < chunks(); ++chunk) {
    for (std::size_t at = grouping_.first[chunk]; at < grouping_.first[chunk + 1]; ++at) {
      const auto choose = [&](std::uint32_t body, std::size_t lane) {
        if (!(problem.inverse_mass[body] > 0.0)) return static_cast<std::uint32_t>(n + chunk);
        if (sequence_.hub(body) == sweep::Sequence::kNoHub) return body;
        std::size_t slot = 0;  // lanes before this one that have the hub
        for (std::size_t k = 0; k < lane; ++k) {
          const std::uint32_t i = grouping_.groups[at][k];
          slot += i != sweep::kNoContact && (problem.contacts[i].a == body || problem.contacts[i].b == body) ? 1 : 0;
        }
        return copies_.take(sequence_, body, chunk, phase[chunk], slot);
      };
      groups_[at].a.fill(static_cast<std::uint32_t>(n + chunk));
      groups_[at].b = groups_[at].a;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t i = grouping_.groups[at][k];
        if (i == sweep::kNoContact) continue;
        groups_[at].a[k] = choose(problem.contacts[i].a, k);
        groups_[at].b[k] = choose(problem.contacts[i].b, k);
      }
    }
  }
  copies_.finish(phases());
}

void ContactSweep::bind_bodies(const CcpProblem& problem) {
  const std::size_t n = problem.bodies(), nothings = std::max<std::size_t>(1, chunks());
  const auto is_isotropic = [](const Mat3& j) { return j == Mat3::diagonal({j.row0.x, j.row0.x, j.row0.x}); };
  const bool isotropic = std::all_of(problem.inverse_inertia.begin(), problem.inverse_inertia.end(), is_isotropic);
  bodies_.assign(n + nothings + copies_.size(), sweep::Body{});
  inertias_.assign(isotropic ? 0 : bodies_.size(), sweep::Inertia{});
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
  for (std::size_t k = 0; k < copies_.size(); ++k) {
    const std::uint32_t hub = copies_.hub(k);
    const double weight = copies_.weight(k);
    bodies_[n + nothings + k].linear[3] = weight * bodies_[hub].linear[3];
    bodies_[n + nothings + k].angular[3] = weight * bodies_[hub].angular[3];
    if (isotropic) continue;
    for (std::size_t c = 0; c < 3; ++c) inertias_[n + nothings + k].column[c] = weight * inertias_[hub].column[c];
  }
}

void ContactSweep::bind_groups(const CcpProblem& problem, const Settings& settings) {
  compliance_.assign(problem.compliance.empty() ? 0 : groups_.size(), Lanes3{});
  for (std::size_t at = 0; at < groups_.size(); ++at) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t i = grouping_.groups[at][k];
      if (i == sweep::kNoContact) continue;
      const double a = copies_.weight_of(groups_[at].a[k]), b = copies_.weight_of(groups_[at].b[k]);
      put_contact(problem, at, static_cast<int>(k), i, step_of(lighter_block(problem, i, a, b), problem, i, settings));
    }
  }
}

void ContactSweep::put_contact(const CcpProblem& problem, std::size_t at, int lane, std::size_t i,
                               const sweep::LocalStep& step) {
  const CcpContact& c = problem.contacts[i];
  sweep::Group& group = groups_[at];
  put(group.normal, lane, c.normal);
  put(group.tangent1, lane, contact_frame(c.normal).tangent1);
  put(group.arm_a, lane, c.arm_a);
  put(group.arm_b, lane, c.arm_b);
  put(group.r, lane, load_block(problem.r, i));
  group.step_n[lane] = step.normal, group.step_t[lane] = step.tangent;
  group.along[lane] = step.weights.along, group.across[lane] = step.weights.across, group.friction[lane] = c.friction;
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
