// Rows: where the items lie that those of one cell can meet.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace scree::grid {

/// Five rows of cells: ranges of sorted items. The first one begins behind the item in question, and may end before it begins.
struct Rows {
  std::array<std::uint32_t, 9> first{};  // the last four are never used
  std::array<std::uint32_t, 5> last{};
  bool are_short = false;   // no row has more items than there are lanes
  std::uint64_t items = 0;  // of short rows: a bit an item, a byte a row

  /// To be called when all but the first row are set.
  void note_lengths() {
    are_short = true;
    items = 0;
    for (std::size_t k = 1; k < 5; ++k) {
      const std::uint32_t length = last[k] - first[k];
      are_short &= length <= 8;
      items |= ((std::uint64_t{1} << std::min(length, 8u)) - 1) << (8 * k);
    }
    others_are_short_ = are_short;
  }
  void begin_at(std::uint32_t item) {
    first[0] = item;
    const std::uint32_t length = last[0] > item ? last[0] - item : 0;
    are_short = others_are_short_ & (length <= 8);
    items = (items & ~std::uint64_t{0xff}) | ((std::uint64_t{1} << std::min(length, 8u)) - 1);
  }

 private:
  bool others_are_short_ = false;
};

}  // namespace scree::grid
