// Kernels of one block: what its Jacobian does to two body velocities and to its impulse, and its share of N.
#pragma once

#include <array>
#include <span>

#include "scree/ccp/problem.hpp"

namespace scree {

/// The numbers of one block, one a row; the first block.rows of them count.
using BlockVector = std::array<double, CcpBlock::kMostRows>;

/// First row of a block in gamma, r and compliance.
inline std::size_t first_row(const CcpProblem& problem, const CcpBlock& block) {
  return problem.contact_rows() + block.first_row;
}
/// The numbers of a block in an array of all rows.
template <class Number>
std::span<Number> rows_of(const CcpProblem& problem, const CcpBlock& block, std::span<Number> all) {
  return all.subspan(first_row(problem, block), block.rows);
}
/// The Jacobian rows of a block of a problem with bodies.
inline std::span<const CcpRow> jacobian_of(const CcpProblem& problem, const CcpBlock& block) {
  return problem.block_rows.subspan(block.first_row, block.rows);
}

constexpr double dot(const Twist& a, const Twist& b) { return dot(a.linear, b.linear) + dot(a.angular, b.angular); }

/// D_i^T w, one number a row [m/s], for the velocities `a` and `b` of the block's bodies.
inline void relative_velocity(std::span<const CcpRow> jacobian, const Twist& a, const Twist& b, std::span<double> u) {
  for (std::size_t k = 0; k < jacobian.size(); ++k) u[k] = dot(jacobian[k].a, a) + dot(jacobian[k].b, b);
}

/// D_i g: adds the impulse `g` [N s] to the sums of both bodies, which may be one and the same.
inline void add_impulse(std::span<const CcpRow> jacobian, std::span<const double> g, Twist& a, Twist& b) {
  for (std::size_t k = 0; k < jacobian.size(); ++k) {
    const CcpRow& row = jacobian[k];
    a.linear += g[k] * row.a.linear;
    a.angular += g[k] * row.a.angular;
    b.linear += g[k] * row.b.linear;
    b.angular += g[k] * row.b.angular;
  }
}

/// Block row i of problem.matrix times `gamma` (all rows) [m/s], without the compliance.
void multiply_block_row(const CcpProblem& problem, std::size_t block, std::span<const double> gamma,
                        std::span<double> u);

/// N_ii of block `block` (counted from 0 after the contacts), rows x rows numbers row by row [1/kg]; symmetric positive
/// semi-definite. Includes the compliance.
void diagonal_block_of_block(const CcpProblem& problem, std::size_t block, std::span<double> n);

/// trace(N_ii) of block `block` [1/kg].
[[nodiscard]] double diagonal_trace_of_block(const CcpProblem& problem, std::size_t block);

}  // namespace scree
