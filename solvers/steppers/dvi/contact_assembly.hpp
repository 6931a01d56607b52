// ContactAssembly: from the contacts of a step to its cone complementarity
// problem (Critelli et al., eqs 3-8; Tasora & Anitescu 2011, eq. 20).
//
// Glossary: h, the step; Phi, the gap; v0, velocities at the beginning of the
// step; v_f = v0 + h M^-1 f, the free velocities; u = D^T v, a contact velocity
// in the contact's frame, separation positive; e, restitution; k = 1 /
// compliance, stiffness; d, damping.
//
//     r = D^T v_f + b,
//     b_n = max(Phi / h, -recovery_speed)   Phi <= 0
//           Phi / h                         Phi > 0: closes at most, never crosses
//     b_n = min(b_n, e u_n(v0))             an impact: u_n(v0) < -min_bounce_speed
//                                           and Phi + h u_n(v_f) <= 0
//     b_t = D_t^T of the motion of the surfaces against their bodies (surface_motion.hpp)
//     b_n = k / (h k + d) Phi,  E_n = 1 / (h (h k + d))     a compliant contact
//
// Contacts that resist rolling or spinning are blocks of six rows
// (rolling_contact.hpp); b and E of their normal are the same, those of the
// other rows zero.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "rolling_contact.hpp"
#include "scree/ccp/problem.hpp"
#include "scree/ccp/twist.hpp"
#include "scree/machine/machine.hpp"
#include "spatial_order.hpp"

namespace scree {
class Executor;
class Materials;
}  // namespace scree

namespace scree::dvi {

/// What decides the right-hand side beside the materials.
struct ContactLimits {
  double recovery_speed = 0.15;   ///< greatest speed at which overlap is undone [m/s]
  double min_bounce_speed = 0.1;  ///< slower impacts do not bounce [m/s]
};

/// State of all bodies that an assembly reads.
struct FreeMotion {
  BodyView bodies;                         ///< at the beginning of the step
  std::span<const Vec3> velocity;          ///< v_f [m/s]
  std::span<const Vec3> angular_velocity;  ///< v_f [rad/s], world
};

/// The joints of a step, with the bodies that they tie.
struct JoinedBodies {
  std::span<const BodyIndex> bodies;
  MachineProblem problem;
};

/// Builds the problem and keeps what is needed to read its answer. Its units
/// (contacts, then blocks of six rows, then blocks of joints) are in spatial
/// order each; contacts() stay in the order in which they were found.
class ContactAssembly {
 public:
  /// Contacts between two bodies that forces do not move are left out. `contacts` outlive what is asked here later.
  void build(const FreeMotion& motion, std::span<const Contact> contacts, const Materials& materials,
             const ContactLimits& limits, double dt, const Executor& executor, const JoinedBodies& joined = {});

  [[nodiscard]] CcpProblem problem() const {
    return {.inverse_mass = inverse_mass_,
            .inverse_inertia = inverse_inertia_,
            .contacts = plain_,
            .r = r_,
            .compliance = compliance_,
            .blocks = blocks_,
            .block_rows = block_rows_};
  }
  /// Frees everything but contacts().
  void release_problem();
  /// Bodies of the scene by number in the problem.
  [[nodiscard]] std::span<const BodyIndex> bodies() const { return order_.bodies(); }
  /// Number of a body of the scene in the problem.
  [[nodiscard]] std::uint32_t number(BodyIndex body) const { return order_.number(body); }
  /// The contacts in the problem, as found.
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }

  /// True when contacts resist rolling.
  [[nodiscard]] bool rolls() const { return !rolling_.empty(); }
  /// The first row of the joints; theirs are the last ones.
  [[nodiscard]] std::size_t first_joint_row() const { return first_row_of_unit(contacts_.size()); }

  /// Of contact k as found: its frame and arms, its first row, and what makes rows of angular velocities, or null.
  [[nodiscard]] const CcpContact& geometry(std::size_t k) const {
    const std::size_t unit = unit_of_[k];
    return unit < plain_.size() ? plain_[unit] : rolling_[unit - plain_.size()].contact;
  }
  [[nodiscard]] std::size_t first_row(std::size_t k) const { return first_row_of_unit(unit_of_[k]); }
  [[nodiscard]] const RollingContact* rolling(std::size_t k) const {
    const std::size_t unit = unit_of_[k];
    return unit < plain_.size() ? nullptr : &rolling_[unit - plain_.size()];
  }

 private:
  void keep(const BodyView& bodies, std::span<const Contact> contacts);
  void sort_units(const BodyView& bodies, const Materials& materials);
  void add_joints(const MachineProblem& joints);
  void fill_bodies(const FreeMotion& motion);
  void fill_unit(const FreeMotion& motion, const Materials& materials, const ContactLimits& limits, double dt,
                 std::size_t contact);
  void fill_rolling(const FreeMotion& motion, const ContactMaterial& material, const CcpContact& geometry,
                    std::size_t contact);
  [[nodiscard]] std::size_t first_row_of_unit(std::size_t unit) const {
    const std::size_t plain = std::min(unit, plain_.size());
    return 3 * plain + RollingContact::kRows * (unit - plain);
  }

  SpatialOrder order_;
  std::span<const Contact> contacts_;   ///< those found, or those kept
  std::vector<Contact> kept_;           ///< empty unless some were left out
  std::vector<std::uint32_t> unit_of_;  ///< per contact
  std::vector<std::uint32_t> cursor_;

  std::vector<double> inverse_mass_;
  std::vector<Mat3> inverse_inertia_;
  std::vector<CcpContact> plain_;
  std::vector<RollingContact> rolling_;
  std::vector<CcpBlock> blocks_;    ///< one per rolling contact, then those of joints
  std::vector<CcpRow> block_rows_;  ///< six per rolling contact, then those of joints
  std::vector<double> r_;           ///< one per row
  std::vector<double> compliance_;  ///< one per row, or empty
};

}  // namespace scree::dvi
