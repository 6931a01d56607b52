// Sparse matrices of an FCLIB file. For the sources of this folder; not installed.
#pragma once

#include "scree/ccp/fclib/detail/fclib_group.hpp"
#include "scree/ccp/fclib/fclib_problem.hpp"

namespace scree {

/// Reads the matrix that `in` holds. @throws Error (io) for sizes, indices and numbers that make no matrix.
[[nodiscard]] FclibMatrix read_fclib_matrix(const FclibGroupReader& in);

/// Writes `matrix` in its storage; packed, its entries are sorted and those at the same place summed.
void write_fclib_matrix(const FclibGroupWriter& out, const FclibMatrix& matrix);

}  // namespace scree
