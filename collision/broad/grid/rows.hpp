// Rows: where the items lie that those of one cell can meet.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace scree::grid {

/// Five rows of cells: ranges of sorted items. The first one begins behind the item in question, and may end before it begins.
struct Rows {
  static constexpr std::size_t kRows = 5;
  std::array<std::uint32_t, 9> first{};  // the last four are never used
  std::array<std::uint32_t, kRows> last{};
  bool are_short = false;   // no row has more items than there are lanes
  std::uint64_t items = 0;  // of short rows: a bit an item, a byte a row

  /// The item of a bit; of bit 64 any.
  [[nodiscard]] std::uint32_t item(unsigned bit) const { return first[bit / 8] + bit % 8; }

  /// Sets row k, from 1 on, in order.
  void set(std::size_t k, std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t length = end - begin;
    if (k == 1) longest_other_ = 0, items = 0;
    first[k] = begin;
    last[k] = end;
    longest_other_ = std::max(longest_other_, length);
    items |= lowest(length) << (8 * k);
  }
  /// Sets the first row, when the others are set.
  void begin_at(std::uint32_t item) {
    first[0] = item;
    const std::uint32_t length = last[0] > item ? last[0] - item : 0;
    are_short = std::max(longest_other_, length) <= 8;
    items = (items & ~std::uint64_t{0xff}) | lowest(length);
  }
  /// How many items the rows hold, of which the first one begins at `begin`.
  [[nodiscard]] std::size_t count_from(std::uint32_t begin) const {
    std::size_t sum = last[0] - begin;
    for (std::size_t k = 1; k < kRows; ++k) sum += last[k] - first[k];
    return sum;
  }

 private:
  /// So many bits, eight at most.
  static std::uint64_t lowest(std::uint32_t count) { return 0xffu >> (8u - std::min(count, 8u)); }

  std::uint32_t longest_other_ = 0;
};

}  // namespace scree::grid
