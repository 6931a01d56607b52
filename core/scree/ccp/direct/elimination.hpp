// Elimination: the symbolic part of a sparse Cholesky factorisation by blocks.
//
// Glossary: node, a block of unknowns (a body, a block of rows); edge, two nodes with a non-zero block between them;
// supernode, consecutive nodes of the elimination order with (nearly) the same structure below them, factorised as one dense
// matrix; front, that matrix: the supernode's own unknowns first, then those that it updates (Duff & Reid 1983; Liu 1992,
// "The multifrontal method for sparse matrix solution").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree::direct {

/// Two nodes with a non-zero block.
struct Edge {
  std::uint32_t a = 0, b = 0;                     ///< a < b
  auto operator<=>(const Edge&) const = default;  // NOLINT(modernize-use-nullptr): a fault of clang-tidy 14
};

/// A dense step of the factorisation.
struct Supernode {
  std::uint32_t first = 0, last = 0;              ///< its nodes, in elimination order
  std::uint32_t first_below = 0, last_below = 0;  ///< entries of Elimination::below
  std::uint32_t parent = 0;                       ///< supernode that its update goes to; itself when there is none
  std::uint32_t children = 0;                     ///< how many supernodes update it
  std::uint32_t columns = 0;                      ///< unknowns of its own
  std::uint32_t size = 0;                         ///< of the front: columns and the unknowns below
  std::size_t panel = 0;                          ///< where its size x columns numbers of the factor begin
};

/// Where a block of the matrix goes.
struct Place {
  std::uint32_t supernode = 0;
  std::uint32_t row = 0, column = 0;  ///< in the front
  bool transposed = false;            ///< the block given is that of (column, row)
};

/// Order and structure of a factorisation.
struct Elimination {
  std::vector<std::uint32_t> position;      ///< of each node in the order
  std::vector<std::uint32_t> offset;        ///< first unknown of each position; nodes + 1
  std::vector<Supernode> supernodes;        ///< children before their parents, each subtree contiguous
  std::vector<std::uint32_t> below;         ///< positions below a supernode, ascending
  std::vector<std::uint32_t> below_target;  ///< first row of each in the parent's front
  std::vector<Place> diagonal;              ///< of each node
  std::vector<Place> edge;                  ///< of each edge; the block is that of rows b, columns a
  std::size_t panel_size = 0;               ///< numbers of the factor
  std::size_t largest_front = 0;            ///< unknowns
  std::size_t stack_size = 0;               ///< numbers of the updates that wait at a time, at most
};

/// Orders nodes of `size` unknowns by approximate minimum degree and finds the structure of the factor.
[[nodiscard]] Elimination eliminate(std::span<const std::uint32_t> size, std::span<const Edge> edges);

}  // namespace scree::direct
