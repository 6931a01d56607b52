// Heightfields: heights on a grid, as triangles.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {

/// Heights over a grid in the x-y plane: the one at column i, row k lies at (i dx, k dy).
struct HeightGrid {
  std::size_t columns = 0;      ///< along x, at least 2
  std::size_t rows = 0;         ///< along y, at least 2
  double dx = 0.0, dy = 0.0;    ///< spacing [m], positive
  std::vector<double> heights;  ///< [m], row by row: columns * rows of them
};

/// The surface, two triangles a cell, seen from above: the diagonal of a cell runs from its corner (i, k) to (i + 1, k + 1).
/// It passes through every height, and is the plane itself when the heights lie in one.
/// @param base with it, sides and a flat underside at this height [m] make the surface a closed solid.
/// @throws Error (usage) for fewer than two rows or columns, heights that do not fill them or are not finite, and a base
/// that is not below all heights.
[[nodiscard]] TriangleMesh heightfield_mesh(const HeightGrid& grid, std::optional<double> base = {});

/// Reads heights from a text file: one row a line, from small to large y, numbers apart by blanks, tabs, commas or
/// semicolons; `#` begins a comment. The spacing is left open.
/// @param scale multiplies every height; 1e-3 for files in millimetres [m per unit of the file]
/// @throws Error (io) when the file cannot be read; (usage), with file and line, for a word that is no finite number and
/// rows of different lengths.
[[nodiscard]] HeightGrid read_height_file(const std::filesystem::path& file, double scale = 1.0);

}  // namespace scree
