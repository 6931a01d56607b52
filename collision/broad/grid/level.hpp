// Level: one grid of cells for boxes of similar size.
//
// A box lies in the cell of its centre, and no box is larger than a cell, so what
// a query box can meet lies in the cells that it covers when grown by half a
// cell. Cells are numbered along x first. A level has about four cells a box at
// most: an axis that would need more is wrapped round a power of two (far cells
// then share storage; the boxes themselves tell them apart).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scree/math/vec3.hpp"

namespace scree::grid {

/// Inclusive range of cells along one axis, relative to the first one.
struct CellRange {
  std::int32_t first = 0;
  std::int32_t last = -1;  ///< below `first`: empty
};

/// Cells along one axis.
struct LevelAxis {
  std::int32_t origin = 0;  ///< first occupied cell
  std::int32_t count = 0;   ///< cells from the first to the last occupied one
  std::int32_t stored = 1;  ///< cells stored: count, or a smaller power of two
  bool wrapped = false;

  /// Storage of a cell, given relative to `origin`.
  [[nodiscard]] std::uint32_t store(std::int32_t relative) const {
    return static_cast<std::uint32_t>(wrapped ? relative & (stored - 1) : relative);
  }
  /// The occupied part of the cells lower..upper; at most `stored` of them.
  [[nodiscard]] CellRange clip(std::int32_t lower, std::int32_t upper) const {
    const CellRange range{std::max(lower - origin, 0), std::min(upper - origin, count - 1)};
    return range.last - range.first >= stored ? CellRange{0, stored - 1} : range;
  }
};

/// A grid of cells of one size.
struct Level {
  double cell = 1.0;             ///< edge [m]
  double inverse_cell = 1.0;     ///< [1/m]
  std::uint32_t boxes = 0;       ///< that lie in this level
  std::uint32_t first_cell = 0;  ///< index of its first cell among those of all levels
  std::array<LevelAxis, 3> axis;

  /// The cell number of a coordinate [m].
  [[nodiscard]] std::int32_t cell_of(double x) const {
    // Far outliers share the outermost cells; the order of coordinates is kept.
    constexpr double kFarthest = 1e9;
    return static_cast<std::int32_t>(std::floor(std::clamp(x * inverse_cell, -kFarthest, kFarthest)));
  }
  [[nodiscard]] bool is_wrapped() const { return axis[0].wrapped || axis[1].wrapped || axis[2].wrapped; }
  [[nodiscard]] std::uint32_t cell_count() const {
    return static_cast<std::uint32_t>(axis[0].stored) * static_cast<std::uint32_t>(axis[1].stored) *
           static_cast<std::uint32_t>(axis[2].stored);
  }
  /// Index of a cell among those of all levels.
  [[nodiscard]] std::uint32_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return first_cell + x +
           static_cast<std::uint32_t>(axis[0].stored) * (y + static_cast<std::uint32_t>(axis[1].stored) * z);
  }

  /// Sets storage for cells lower..upper with `boxes` boxes in them.
  void fit(const std::array<std::int32_t, 3>& lower, const std::array<std::int32_t, 3>& upper);
};

}  // namespace scree::grid
