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
//     b_n = k / (h k + d) Phi,  E_n = 1 / (h (h k + d))     a compliant contact
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "scree/ccp/twist.hpp"
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

/// Builds the problem and keeps what is needed to read its answer. Blocks are
/// in spatial order; contacts stay in the order in which they were found.
class ContactAssembly {
 public:
  /// Contacts between two bodies that forces do not move are left out. `contacts` outlive what is asked here later.
  void build(const FreeMotion& motion, std::span<const Contact> contacts, const Materials& materials,
             const ContactLimits& limits, double dt, const Executor& executor);

  [[nodiscard]] CcpProblem problem() const { return {inverse_mass_, inverse_inertia_, blocks_, r_, compliance_}; }
  /// Frees everything but contacts().
  void release_problem();
  /// Bodies of the scene by number in the problem.
  [[nodiscard]] std::span<const BodyIndex> bodies() const { return order_.bodies(); }
  /// The contacts in the problem, as found, and the block of each.
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }
  [[nodiscard]] std::span<const std::uint32_t> block_of() const { return block_of_; }

 private:
  void keep(const BodyView& bodies, std::span<const Contact> contacts);
  void sort_blocks();
  void fill_bodies(const FreeMotion& motion);
  void fill_block(const FreeMotion& motion, const Materials& materials, const ContactLimits& limits, double dt,
                  std::size_t contact);

  SpatialOrder order_;
  std::span<const Contact> contacts_;  ///< those found, or those kept
  std::vector<Contact> kept_;          ///< empty unless some were left out
  std::vector<std::uint32_t> block_of_;
  std::vector<std::uint32_t> cursor_;

  std::vector<double> inverse_mass_;
  std::vector<Mat3> inverse_inertia_;
  std::vector<CcpContact> blocks_;
  std::vector<double> r_;
  std::vector<double> compliance_;
};

}  // namespace scree::dvi
