// DirectSystem: a contact problem with its equations factorised, for solvers that take Newton steps or splitting steps.
//
// Glossary: z, the state; A, rows of the Jacobian in units of the bodies' own masses: A = D^T F with M^-1 = F F^T, so that
// N = A A^T + E; u = A z + r, what a state does to the rows [m/s]; B = C C^T, a symmetric positive semi-definite block per
// unit [kg], in which a solver says how far the impulses of that unit give way to velocities.
//
//     bodies   z, body velocities times the root of their masses [kg^1/2 m/s]; factor of  H = I + A^T B A
//     matrix   z, impulses [N s], and N in place of A;                         factor of  I + C^T N C
//
// Both are the same equations (Woodbury). The first has the pattern of the bodies, the second that of N; the smallest
// eigenvalue of either is 1, however singular N is and however far the masses lie apart.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scree/ccp/direct/aligned.hpp"
#include "scree/ccp/direct/block_cholesky.hpp"
#include "scree/ccp/problem.hpp"

namespace scree::direct {

/// Unknowns of a body.
inline constexpr std::size_t kBodySize = 6;

/// Contacts and blocks alike, in bodies and in an explicit matrix alike. Compliance E is left to the caller.
class DirectSystem {
 public:
  /// Finds order and structure. `problem` stays valid while this is used.
  void bind(const CcpProblem& problem);

  /// All units, first_row counted from the first row of the problem.
  [[nodiscard]] std::span<const CcpBlock> units() const { return units_; }
  /// Where the rows x rows numbers of a unit begin in an array that holds such a block of each.
  [[nodiscard]] std::size_t block_at(std::size_t unit) const { return block_at_[unit]; }
  [[nodiscard]] std::size_t block_numbers() const { return block_at_.back(); }
  [[nodiscard]] std::size_t state_size() const { return state_size_; }
  /// Diagonal of N - E of a row [1/kg].
  [[nodiscard]] double diagonal(std::size_t row) const { return diagonal_[row]; }

  /// The state of `gamma` [N s], one number a row.
  void state_of(std::span<const double> gamma, std::span<double> z) const;
  /// out = A z, or N z [m/s].
  void velocities(std::span<const double> z, std::span<double> out) const;
  /// Inner product of two states [J]; `velocities_of_b` are those of b.
  [[nodiscard]] double inner(std::span<const double> a, std::span<const double> b,
                             std::span<const double> velocities_of_b) const;

  /// Factorises for C, by columns, one block a unit. False when the numbers do not allow it.
  bool factor(std::span<const double> c);
  /// d = -H^-1 q for a mismatch of states q: the Newton direction of 1/2 |z|^2 + sum phi_i(A z), phi_i'' = B_i.
  void newton_direction(std::span<const double> q, std::span<double> d);
  /// x = (N - E + B^-1)^-1 b; C has to have full rank in units that move.
  void solve_regularised(std::span<const double> b, std::span<double> x);

  /// Numbers of the factor, for those who watch memory.
  [[nodiscard]] std::size_t factor_size() const { return cholesky_.factor_size(); }

 private:
  /// What a unit does to its at most two bodies, or to its block row.
  struct Ends {
    std::uint32_t a = 0, b = 0;  ///< nodes; kNone for none
    std::uint32_t edge = 0;      ///< between them, when there are both
  };
  /// F of a body.
  struct BodyRoot {
    double linear = 0.0;  ///< [kg^-1/2]
    Mat3 angular;         ///< [kg^-1/2 m^-1]
  };
  using Row = std::array<double, 2 * kBodySize>;  ///< of A: node a, node b

  void bind_bodies();
  void make_roots();
  void make_rows(std::size_t unit, const CcpRow* jacobian);
  void bind_matrix();
  void factor_bodies();
  void factor_matrix();
  void multiply_matrix(std::span<const double> x, std::span<double> out) const;
  /// out = C x, or C^T x, unit by unit.
  void multiply_root(std::span<const double> x, bool transposed, std::span<double> out) const;

  const CcpProblem* problem_ = nullptr;
  std::vector<CcpBlock> units_;
  std::vector<std::size_t> block_at_;
  std::vector<double> diagonal_;
  std::size_t state_size_ = 0;
  BlockCholesky cholesky_;
  AlignedVector<double> c_;
  std::vector<double> work_, regularised_;
  // With bodies:
  std::vector<std::uint32_t> node_;  ///< of each body, kNone for immovable ones
  std::vector<BodyRoot> roots_;      ///< of each node
  std::vector<Ends> ends_;
  AlignedVector<Row> rows_;
};

}  // namespace scree::direct
