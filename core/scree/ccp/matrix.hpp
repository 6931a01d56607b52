// CcpMatrixStore: an explicit matrix N that owns its numbers, made from single entries.
//
// Files of other programs bring matrices that are symmetric only in theory: a capsule that tumbles leaves gyroscopic terms
// of a thousandth in N. Solvers get (N + N^T)/2; what remains is left to an outer iteration (coulomb.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scree/ccp/problem.hpp"

namespace scree {

/// A number of a sparse matrix.
struct MatrixEntry {
  std::uint32_t row = 0, column = 0;
  double value = 0.0;  ///< of the unit of the matrix [1]
};

/// Owns what a CcpMatrix refers to.
struct CcpMatrixStore {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> column;
  std::vector<std::size_t> value;
  std::vector<double> values;  ///< [1/kg]

  /// Valid while the store is neither moved nor changed.
  [[nodiscard]] CcpMatrix view() const { return {first, column, value, values}; }
};

/// The matrix of `entries`, cut into the rows of `blocks`. Entries at the same place are summed; every block of the diagonal
/// is there, and (j, i) wherever (i, j) is.
[[nodiscard]] CcpMatrixStore make_matrix(std::span<const CcpBlock> blocks, std::span<const MatrixEntry> entries);

/// max |N_kl - N_lk| over max |N_kl| [1]; 0 for a matrix of zeros. `matrix` has (j, i) wherever it has (i, j).
[[nodiscard]] double asymmetry(const CcpMatrix& matrix, std::span<const CcpBlock> blocks);

/// The numbers of (N + N^T)/2, in the places of those of N.
[[nodiscard]] std::vector<double> symmetric_values(const CcpMatrix& matrix, std::span<const CcpBlock> blocks);

}  // namespace scree
