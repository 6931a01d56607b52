// Morton code: a number for a cell of a grid, such that cells with near numbers are near in space.
//
// Morton 1966, A computer oriented geodetic data base and a new technique in file sequencing (IBM).
#pragma once

#include <cstdint>

namespace scree {

/// Bits of a coordinate that a code holds.
inline constexpr int kMortonBits = 21;

/// The lower 21 bits, with two zeros between any two of them.
constexpr std::uint64_t spread_bits(std::uint64_t x) {
  x &= (std::uint64_t{1} << kMortonBits) - 1;
  x = (x | (x << 32)) & 0x001f00000000ffffULL;
  x = (x | (x << 16)) & 0x001f0000ff0000ffULL;
  x = (x | (x << 8)) & 0x100f00f00f00f00fULL;
  x = (x | (x << 4)) & 0x10c30c30c30c30c3ULL;
  return (x | (x << 2)) & 0x1249249249249249ULL;
}

/// The code of a cell, by its whole coordinates, each below 2^21.
constexpr std::uint64_t morton_code(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return spread_bits(x) | (spread_bits(y) << 1) | (spread_bits(z) << 2);
}

}  // namespace scree
