#include "level.hpp"

#include <bit>

namespace scree::grid {

void Level::fit(const std::array<std::int32_t, 3>& lower, const std::array<std::int32_t, 3>& upper) {
  for (std::size_t k = 0; k < 3; ++k) {
    axis[k].origin = lower[k];
    axis[k].count = upper[k] - lower[k] + 1;
    axis[k].stored = axis[k].count;
    axis[k].wrapped = false;
  }
  const double most = 4.0 * boxes + 8.0;
  const auto needed = [&] { return double{1} * axis[0].stored * axis[1].stored * axis[2].stored; };
  while (needed() > most) {
    LevelAxis& longest = *std::max_element(axis.begin(), axis.end(),
                                           [](const LevelAxis& l, const LevelAxis& r) { return l.stored < r.stored; });
    // The largest power of two below the present length.
    longest.stored = static_cast<std::int32_t>(std::bit_floor(static_cast<std::uint32_t>(longest.stored - 1)));
    longest.wrapped = true;
  }
  if (!is_wrapped()) {
    for (LevelAxis& a : axis) ++a.stored;
  }
  std::int32_t stride = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    origin_[k] = axis[k].origin;
    mask_[k] = axis[k].wrapped ? axis[k].stored - 1 : -1;
    stride_[k] = stride;
    stride *= axis[k].stored;
  }
}

}  // namespace scree::grid
