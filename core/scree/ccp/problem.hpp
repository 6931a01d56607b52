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
// First come the contacts: rows 3i .. 3i+2 are normal, tangent 1 and tangent 2
// of contact i in contact_frame(normal). The velocity of body k is v_k + w_k x
// arm; the relative velocity of a contact is that of b minus that of a.
//
// Then come the blocks of any other kind: joints, limits, motors, contacts that
// also resist rolling. They are fewer, so each row has its Jacobian written out.
// All rows are velocities [m/s] and impulses [N s]: whoever makes an angular row
// multiplies it by a length, and divides what follows from it.
//
// A problem may also come without bodies, with N as an explicit matrix; then all
// of it is blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scree/math/mat3.hpp"
#include "scree/math/twist.hpp"

namespace scree {

/// A contact block, Coulomb cone ||(g_1, g_2)|| <= friction * g_0.
struct CcpContact {
  Vec3 normal;                 ///< from a to b [1], world
  Vec3 arm_a;                  ///< contact point relative to the centre of mass of a [m], world
  Vec3 arm_b;                  ///< contact point relative to the centre of mass of b [m], world
  double friction = 0.0;       ///< [1]
  std::uint32_t a = 0, b = 0;  ///< bodies of the problem; an immovable one has a
                               ///< zero inverse mass
};

/// Which impulses a block may have, and so which velocities.
enum class CcpKind : std::uint8_t {
  free,         ///< all: u = 0 (joints)
  nonnegative,  ///< g >= 0, u >= 0, g u = 0, row by row (limits, stops)
  box,   ///< lower <= g <= upper, row by row; u = 0 inside, u >= 0 at lower, u <= 0 at upper (motors with limits)
  cone,  ///< friction of every sort, see CcpBlock
};

/// A block of 1 to 6 rows. A cone has its rows in this order, and by their number
///     1  normal                                    g_n >= 0
///     2  normal, tangent                           |t| <= friction g_n (plane problems)
///     3  normal, tangent 1, 2                      ||t|| <= friction g_n
///     5  normal, tangent 1, 2, rolling 1, 2        and ||rho|| <= rolling g_n
///     6  normal, tangent 1, 2, spin, rolling 1, 2  and |s| <= spinning g_n
struct CcpBlock {
  static constexpr std::size_t kMostRows = 6;

  CcpKind kind = CcpKind::free;
  std::uint8_t rows = 1;        ///< 1..6
  std::uint32_t first_row = 0;  ///< counted from the first row after the contacts
  std::uint32_t a = 0, b = 0;   ///< bodies of the problem, as in CcpContact; may be the same; unused with a matrix
  double friction = 0.0;        ///< cone [1]
  double spinning = 0.0;        ///< cone of 6 rows [1]: coefficient [m] over the length that its row was multiplied by
  double rolling = 0.0;         ///< cone of 5 or 6 rows [1], as spinning
  double lower = 0.0;           ///< box [N s]; may be -infinity
  double upper = 0.0;           ///< box [N s], >= lower; may be +infinity
};

/// A row of the Jacobian of a block: u = a . (velocity of a) + b . (velocity of b), six products each.
struct CcpRow {
  Twist a, b;  ///< linear [1], angular [m], world
};

/// N by its non-zero blocks, for problems without bodies: block row i has the
/// blocks k = first[i] .. first[i + 1] - 1 at block columns column[k]
/// (ascending), each with its numbers from values[value[k]] on, row by row.
/// Symmetric and positive semi-definite.
struct CcpMatrix {
  std::span<const std::uint32_t> first;   ///< blocks + 1; empty: the problem has bodies
  std::span<const std::uint32_t> column;  ///< one per non-zero block
  std::span<const std::size_t> value;     ///< one per non-zero block
  std::span<const double> values;         ///< [1/kg]

  [[nodiscard]] bool empty() const { return first.empty(); }
};

/// The problem of one step. All spans stay valid during a solve.
struct CcpProblem {
  std::span<const double> inverse_mass;     ///< per body [1/kg]
  std::span<const Mat3> inverse_inertia;    ///< per body, world frame [1/(kg m2)]
  std::span<const CcpContact> contacts;     ///< m contacts
  std::span<const double> r;                ///< one a row [m/s]
  std::span<const double> compliance;       ///< E, one a row [1/kg]; empty for none
  std::span<const CcpBlock> blocks = {};    ///< after the contacts, in order of first_row, without holes
  std::span<const CcpRow> block_rows = {};  ///< Jacobian of the blocks; empty with a matrix
  CcpMatrix matrix = {};                    ///< N - E, where there are no bodies and no contacts

  [[nodiscard]] std::size_t bodies() const { return inverse_mass.size(); }
  /// Rows of contacts; those of the blocks follow.
  [[nodiscard]] std::size_t contact_rows() const { return 3 * contacts.size(); }
  [[nodiscard]] std::size_t rows() const {
    return contact_rows() + (blocks.empty() ? 0 : blocks.back().first_row + std::size_t{blocks.back().rows});
  }
  /// Contacts and blocks.
  [[nodiscard]] std::size_t units() const { return contacts.size() + blocks.size(); }
  [[nodiscard]] bool empty() const { return contacts.empty() && blocks.empty(); }
};

}  // namespace scree
