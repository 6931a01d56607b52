// CcpProblem: one cone complementarity problem, flat and read-only.
//
// Glossary: gamma, the impulses [N s]; D, the Jacobian (columns: constraint
// directions); M, the mass matrix; E, a diagonal of compliance; N = D^T M^-1 D
// + E, the Delassus operator; r = D^T (v0 + h M^-1 f) + b, the velocity that
// remains without impulses [m/s]; K, the product of the blocks' cones; mu, the
// coefficient of friction.
//
//     find gamma in K with u = N gamma + r in K*, gamma _|_ u (Tasora &
//     Anitescu 2011, eq. 20 ff.)
//
// Each block is one contact: rows 3i .. 3i+2 are its normal, tangent 1 and
// tangent 2 in contact_frame(normal). The velocity of body k is v_k + w_k x
// arm; the relative velocity of a block is that of b minus that of a.
#pragma once

#include <cstdint>
#include <span>

#include "scree/math/mat3.hpp"

namespace scree {

/// A contact block, Coulomb cone ||(g_1, g_2)|| <= friction * g_0.
struct CcpContact {
  Vec3 normal;                 ///< from a to b [1], world
  Vec3 tangent1;               ///< [1], world; tangent 2 = normal x tangent 1
  Vec3 arm_a;                  ///< contact point relative to the centre of mass of a [m], world
  Vec3 arm_b;                  ///< contact point relative to the centre of mass of b [m], world
  double friction = 0.0;       ///< [1]
  std::uint32_t a = 0, b = 0;  ///< bodies of the problem; an immovable one has a
                               ///< zero inverse mass
};

/// The problem of one step. All spans stay valid during a solve.
struct CcpProblem {
  std::span<const double> inverse_mass;   ///< per body [1/kg]
  std::span<const Mat3> inverse_inertia;  ///< per body, world frame [1/(kg m2)]
  std::span<const CcpContact> contacts;   ///< m blocks
  std::span<const double> r;              ///< 3 m [m/s]
  std::span<const double> compliance;     ///< E, 3 m [1/kg]; empty for none

  [[nodiscard]] std::size_t bodies() const { return inverse_mass.size(); }
  [[nodiscard]] std::size_t blocks() const { return contacts.size(); }
  [[nodiscard]] std::size_t rows() const { return 3 * contacts.size(); }
};

}  // namespace scree
