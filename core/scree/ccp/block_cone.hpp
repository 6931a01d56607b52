// The sets that the impulses of a block may lie in, and their projections.
//
// Glossary: g, the impulse of a block; n, its normal part; x_k, its parts that friction holds: tangential t, spinning s,
// rolling rho, with their coefficients mu_k >= 0. A cone is
//
//     K = {||x_k|| <= mu_k n for every k},    K* = {u: u_n >= sum_k mu_k ||u_k||}
//
// (Tasora & Anitescu 2013, with the three kinds of friction side by side). With n given, the nearest x_k is g_k cut to
// the length mu_k n, so that n alone is looked for:
//
//     minimise d_n (n - g_n)^2 + sum_k d_k max(0, ||g_k|| - mu_k n)^2 over n >= 0,
//
// convex and quadratic between the break points ||g_k|| / mu_k. Its derivative grows: leave out part after part in the
// order of break points until the quadratic's own minimum comes before the next one. Exact, not iterative.
#pragma once

#include <span>

#include "scree/ccp/problem.hpp"

namespace scree {

/// Weights of a norm d_n n^2 + d_t ||t||^2 + d_s s^2 + d_r ||rho||^2 of a cone, all > 0; only their ratios count.
struct BlockMetric {
  double normal = 1.0;   ///< d_n [1]
  double tangent = 1.0;  ///< d_t [1]
  double spin = 1.0;     ///< d_s [1]
  double rolling = 1.0;  ///< d_r [1]
};

/// Moves `g` (block.rows numbers, finite) [N s] to the nearest impulse that the block may have. Points that it may have
/// keep their bits.
void project_block(const CcpBlock& block, std::span<double> g);
/// The same in another norm; it changes cones only.
void project_block(const CcpBlock& block, const BlockMetric& metric, std::span<double> g);

/// sum_k mu_k ||u_k|| [m/s] of a velocity `u` (block.rows numbers) of a cone: what u_n has to reach for u to lie in K*, and
/// what exact Coulomb friction adds to u_n (De Saxce & Feng 1998). Zero for all other kinds.
[[nodiscard]] double dissipation_rate(const CcpBlock& block, std::span<const double> u);

/// How far `g` (block.rows numbers) [N s] is outside of what the block may have: the largest of the excesses over its bounds,
/// -g_n and ||x_k|| - mu_k g_n of a cone; <= 0 inside.
[[nodiscard]] double violation(const CcpBlock& block, std::span<const double> g);

/// A contact as a block, for what holds for cones of every sort.
[[nodiscard]] inline CcpBlock block_of(const CcpContact& contact) {
  return {.kind = CcpKind::cone, .rows = 3, .a = contact.a, .b = contact.b, .friction = contact.friction};
}

}  // namespace scree
