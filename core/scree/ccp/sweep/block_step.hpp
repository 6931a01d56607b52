// The step of one general block in methods that go block by block (Gauss-Seidel, Jacobi).
//
// Glossary: n, the rows of a block, 1 to 6; A, its n x n part of N, or an upper bound of that, symmetric and positive
// semi-definite [1/kg]; g, its impulse [N s]; u, its velocity [m/s]; omega, the relaxation [1]. A step lowers
//
//     u . (x - g) + 1/2 (x - g)^T A (x - g)        over the x that the block may have,
//
// and never raises it for omega < 2:
//
//     free                x = g - omega A^+ u, at once; rows that depend on others of the block are left to those
//     nonnegative, box    row by row, each to its exact minimum
//     cone                x = P(g - omega d^-1 u) in the norm of d, a diagonal with diag(d) >= A and one weight for each sort
//                         of friction; with omega = 1 several times, until the minimum over the block is near
//
// The bound: with l_p the largest eigenvalue of the diagonal part p of A and c_pq the norm of A_pq, A is at most
// sum_p l_p (C w)_p / w_p for C_pq = c_pq / sqrt(l_p l_q) and any w > 0; best for w the Perron vector of C.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/block_cone.hpp"
#include "scree/ccp/problem.hpp"

namespace scree::sweep {

/// How long the steps are.
struct StepSettings {
  bool scalar_step = false;  ///< one stiffness for all rows of a contact or cone
  double relaxation = 1.0;   ///< omega [1], in (0, 2)
};

/// A diagonal that bounds `a` (n x n, by rows) from above, for impulses of a cone. Parts without friction are left out:
/// they carry no impulse.
[[nodiscard]] BlockMetric bounding_metric(const CcpBlock& block, std::span<const double> a);

/// The steps of all blocks of a problem. Keeps its memory between problems.
class BlockSteps {
 public:
  /// A of block k is block_weights[k] times its part of N - E, to which each body adds first body_weights[body] times its
  /// share, plus E. Empty weights are all 1. The spans of `problem` stay valid during the use.
  void bind(const CcpProblem& problem, const StepSettings& settings, std::span<const double> body_weights = {},
            std::span<const double> block_weights = {});

  /// Moves the impulse `g` of block k, whose velocity is `u`.
  void advance(std::size_t k, std::span<const double> u, std::span<double> g) const;
  /// A of block k, by rows; of free blocks A^+.
  [[nodiscard]] std::span<const double> matrix(std::size_t k) const {
    return std::span{matrices_}.subspan(first_[k], first_[k + 1] - first_[k]);
  }
  [[nodiscard]] double relaxation() const { return relaxation_; }
  /// Steps that a cone takes at most, and the share of the first one's change (squared) at which the others are not taken.
  [[nodiscard]] int cone_steps() const { return cone_steps_; }
  static constexpr double kSmallChange = 1e-6;  ///< [1]
  /// Per row, d of cones, of other blocks the diagonal of A [1/kg].
  [[nodiscard]] std::span<const double> stiffness() const { return stiffness_; }

 private:
  void prepare(std::size_t k, const StepSettings& settings);
  void advance_rows(std::size_t k, std::span<const double> u, std::span<double> g) const;
  void advance_cone(std::size_t k, std::span<const double> u, std::span<double> g) const;

  std::span<const CcpBlock> blocks_;
  double relaxation_ = 1.0;
  int cone_steps_ = 1;
  std::vector<std::size_t> first_;  ///< of the block's numbers in matrices_
  std::vector<double> matrices_;    ///< A by rows; A^+ of free blocks
  std::vector<double> stiffness_;
};

}  // namespace scree::sweep
