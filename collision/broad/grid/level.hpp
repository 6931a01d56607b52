// Level: one grid of cells for boxes of similar size.
//
// A box lies in the cell of its centre, and no box is larger than a cell, so what
// a query box can meet lies in the cells that it covers when grown by half a
// cell. Cells are numbered along x first. A level has about four cells a box at
// most: an axis that would need more is wrapped round a power of two (far cells
// then share storage; the boxes themselves tell them apart). Behind the last cell
// of an axis lies an empty one where nothing is wrapped, so that the cells round
// a cell are found without a look at where the level ends.
#pragma once

#ifdef __AVX2__
#include <immintrin.h>
#endif

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
  std::int32_t stored = 1;  ///< cells stored: count and an empty one, or a smaller power of two
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
    return static_cast<std::int32_t>(std::floor(std::clamp(x * inverse_cell, -kFarthest, kFarthest)));
  }
  [[nodiscard]] bool is_wrapped() const { return axis[0].wrapped || axis[1].wrapped || axis[2].wrapped; }
  [[nodiscard]] std::uint32_t cell_count() const {
    const auto [width, depth, height] = stored();
    return width * depth * height + (is_wrapped() ? 0 : width + 2);
  }
  /// Cells stored along x, y and z.
  [[nodiscard]] std::array<std::uint32_t, 3> stored() const {
    return {static_cast<std::uint32_t>(axis[0].stored), static_cast<std::uint32_t>(axis[1].stored),
            static_cast<std::uint32_t>(axis[2].stored)};
  }
  /// Index of a cell among those of all levels.
  [[nodiscard]] std::uint32_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return first_cell + x +
           static_cast<std::uint32_t>(axis[0].stored) * (y + static_cast<std::uint32_t>(axis[1].stored) * z);
  }

  /// Index of the cell of a point [m] that lies in one of those that fit() was told of; four numbers, the last of which is not
  /// used.
  [[nodiscard]] std::uint32_t index_of(const float* point) const {
#ifdef __AVX2__
    const __m256d far = _mm256_set1_pd(kFarthest);
    const __m256d scaled = _mm256_mul_pd(_mm256_cvtps_pd(_mm_loadu_ps(point)), _mm256_set1_pd(inverse_cell));
    const __m256d near = _mm256_max_pd(_mm256_min_pd(scaled, far), _mm256_sub_pd(_mm256_setzero_pd(), far));
    const auto load = [](const std::array<std::int32_t, 4>& numbers) {
      return _mm_load_si128(reinterpret_cast<const __m128i*>(numbers.data()));
    };
    const __m128i relative = _mm_sub_epi32(_mm256_cvttpd_epi32(_mm256_floor_pd(near)), load(origin_));
    const __m128i parts = _mm_mullo_epi32(_mm_and_si128(relative, load(mask_)), load(stride_));
    const __m128i pairs = _mm_add_epi32(parts, _mm_unpackhi_epi64(parts, parts));
    return first_cell + static_cast<std::uint32_t>(_mm_cvtsi128_si32(pairs) + _mm_extract_epi32(pairs, 1));
#else
    std::int32_t sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += ((cell_of(double{point[k]}) - origin_[k]) & mask_[k]) * stride_[k];
    }
    return first_cell + static_cast<std::uint32_t>(sum);
#endif
  }

  /// Sets storage for cells lower..upper with `boxes` boxes in them.
  void fit(const std::array<std::int32_t, 3>& lower, const std::array<std::int32_t, 3>& upper);

 private:
  /// Far outliers share the outermost cells; the order of coordinates is kept.
  static constexpr double kFarthest = 1e9;

  // What index_of() needs of the axes, side by side; zero at the end.
  alignas(16) std::array<std::int32_t, 4> origin_{}, mask_{}, stride_{};
};

}  // namespace scree::grid
