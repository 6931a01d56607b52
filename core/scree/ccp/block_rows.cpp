#include "scree/ccp/block_rows.hpp"

#include <algorithm>

#include "scree/ccp/delassus.hpp"

namespace scree {
namespace {

/// Index of the block (i, i) among the non-zero ones; that of the end of the row when it is zero.
std::size_t diagonal_place(const CcpMatrix& matrix, std::size_t i) {
  const auto begin = matrix.column.begin();
  const auto end = begin + matrix.first[i + 1];
  const auto at = std::lower_bound(begin + matrix.first[i], end, static_cast<std::uint32_t>(i));
  return static_cast<std::size_t>((at != end && *at == i ? at : end) - begin);
}

/// N_ii from the Jacobian: sums of row_k M^-1 row_l over the bodies.
void assemble_diagonal(const CcpProblem& problem, const CcpBlock& block, std::span<double> n) {
  const std::span<const CcpRow> rows = jacobian_of(problem, block);
  const bool one_body = block.a == block.b;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Twist at_a = rows[k].a;
    if (one_body) at_a += rows[k].b;
    const Twist a = apply_inverse_mass(problem, block.a, at_a), b = apply_inverse_mass(problem, block.b, rows[k].b);
    for (std::size_t l = 0; l <= k; ++l) {
      const double sum = one_body ? dot(rows[l].a, a) + dot(rows[l].b, a) : dot(rows[l].a, a) + dot(rows[l].b, b);
      n[k * rows.size() + l] = n[l * rows.size() + k] = sum;
    }
  }
}

/// multiply_block_row() for contacts only, three numbers each: nine products in a row, which is what most matrices have.
bool multiply_contact_row(const CcpProblem& problem, std::size_t block, std::span<const double> gamma,
                          std::span<double> u) {
  const CcpMatrix& matrix = problem.matrix;
  if (problem.blocks[block].rows != 3) return false;
  double x = 0.0, y = 0.0, z = 0.0;
  for (std::size_t k = matrix.first[block]; k < matrix.first[block + 1]; ++k) {
    const CcpBlock& column = problem.blocks[matrix.column[k]];
    if (column.rows != 3) return false;
    const double* n = matrix.values.data() + matrix.value[k];
    const double* g = gamma.data() + column.first_row;
    x += n[0] * g[0] + n[1] * g[1] + n[2] * g[2];
    y += n[3] * g[0] + n[4] * g[1] + n[5] * g[2];
    z += n[6] * g[0] + n[7] * g[1] + n[8] * g[2];
  }
  u[0] = x, u[1] = y, u[2] = z;
  return true;
}

}  // namespace

void multiply_block_row(const CcpProblem& problem, std::size_t block, std::span<const double> gamma,
                        std::span<double> u) {
  if (multiply_contact_row(problem, block, gamma, u)) return;
  const CcpMatrix& matrix = problem.matrix;
  const std::size_t rows = problem.blocks[block].rows;
  BlockVector sum{};
  for (std::size_t k = matrix.first[block]; k < matrix.first[block + 1]; ++k) {
    const CcpBlock& column = problem.blocks[matrix.column[k]];
    const double* values = matrix.values.data() + matrix.value[k];
    const double* g = gamma.data() + column.first_row;
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < column.rows; ++j) sum[i] += values[i * column.rows + j] * g[j];
    }
  }
  std::copy_n(sum.begin(), rows, u.begin());
}

void diagonal_block_of_block(const CcpProblem& problem, std::size_t block, std::span<double> n) {
  const CcpBlock& b = problem.blocks[block];
  const std::size_t rows = b.rows;
  if (problem.matrix.empty()) {
    assemble_diagonal(problem, b, n);
  } else {
    const std::size_t k = diagonal_place(problem.matrix, block);
    if (k == problem.matrix.first[block + 1]) {
      std::fill_n(n.begin(), rows * rows, 0.0);
    } else {
      std::copy_n(problem.matrix.values.begin() + static_cast<std::ptrdiff_t>(problem.matrix.value[k]), rows * rows,
                  n.begin());
    }
  }
  if (problem.compliance.empty()) return;
  const std::span<const double> compliance = rows_of(problem, b, problem.compliance);
  for (std::size_t k = 0; k < rows; ++k) n[k * rows + k] += compliance[k];
}

double diagonal_trace_of_block(const CcpProblem& problem, std::size_t block) {
  std::array<double, CcpBlock::kMostRows * CcpBlock::kMostRows> n;
  diagonal_block_of_block(problem, block, n);
  const std::size_t rows = problem.blocks[block].rows;
  double trace = 0.0;
  for (std::size_t k = 0; k < rows; ++k) trace += n[k * rows + k];
  return trace;
}

}  // namespace scree
