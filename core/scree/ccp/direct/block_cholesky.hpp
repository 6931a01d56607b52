// BlockCholesky: L L^T of a sparse symmetric positive definite matrix of small blocks, by the multifrontal method.
//
// Contact problems have blocks of bodies (6 unknowns) or of contacts (3) everywhere; dense fronts use that, where a
// factorisation number by number spends its time on indices.
#pragma once

#include <span>
#include <vector>

#include "scree/ccp/direct/aligned.hpp"
#include "scree/ccp/direct/elimination.hpp"

namespace scree::direct {

/// A matrix and its factor. The structure is found once; factor() may then be called for many matrices of it. The same bits
/// for the same input; serial.
class BlockCholesky {
 public:
  /// Node k has `size`[k] unknowns. Makes all memory but the scratch of the dense kernels.
  void analyse(std::span<const std::uint32_t> size, std::span<const Edge> edges);

  /// Sets the matrix to zero.
  void clear();
  /// The diagonal block of a node, to be added to: size x size, by columns; only the lower triangle is read.
  [[nodiscard]] std::span<double> diagonal(std::size_t node);
  /// The block with rows of edge.b and columns of edge.a, to be added to, by columns.
  [[nodiscard]] std::span<double> off_diagonal(std::size_t edge);

  /// Factorises. False when the matrix is not positive definite, to rounding, or not finite.
  bool factor();
  /// x = A^-1 x, with the unknowns node after node.
  void solve(std::span<double> x);

  /// Numbers of the factor.
  [[nodiscard]] std::size_t factor_size() const { return elimination_.panel_size; }

 private:
  void assemble(std::uint32_t supernode, double* front) const;
  void add_update(const Supernode& child, const Supernode& parent, const double* update, double* front) const;
  void permute(std::span<double> x, bool back);

  Elimination elimination_;
  std::vector<std::uint32_t> size_, first_;         ///< per node
  std::vector<std::size_t> diagonal_at_, edge_at_;  ///< where blocks begin in values_
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> entry_, first_entry_;  ///< blocks by supernode: nodes, then nodes + edge
  std::vector<std::uint32_t> waiting_;              ///< supernodes whose update waits on the stack
  AlignedVector<double> values_, panel_, front_, stack_, x_, below_;
};

}  // namespace scree::direct
