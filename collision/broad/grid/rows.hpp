// Rows: where the items lie that those of one cell can meet.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace scree::grid {

/// Five rows of cells: ranges of sorted items. The first one begins behind the item in question, and may end before it begins.
/// Of the others, up to three may hold more than eight items; what is beyond these is a row more.
struct Rows {
  static constexpr std::size_t kRows = 5;
  static constexpr std::size_t kMost = 8;  // a bit an item, a byte a row

  std::array<std::uint32_t, kMost + 1> first{};  // the last one is never used
  std::array<std::uint32_t, kRows> last{};
  std::size_t count = kRows;  // of rows, with those that hold what is beyond eight
  bool are_short = false;     // as described; otherwise only first and last of five rows mean something
  std::uint64_t items = 0;    // of short rows: a bit an item, a byte a row

  /// The item of a bit; of bit 64 any.
  [[nodiscard]] std::uint32_t item(unsigned bit) const { return first[bit / 8] + bit % 8; }

  /// To be called before set().
  void clear() {
    count = kRows;
    items = 0;
    others_are_short_ = true;
  }
  /// Sets row k, from 1 on.
  void set(std::size_t k, std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t length = end - begin;
    first[k] = begin;
    last[k] = end;
    items |= lowest(length) << (8 * k);
    if (length > 8) add_beyond(begin + 8, length - 8);
  }
  /// Sets the first row, when the others are set.
  void begin_at(std::uint32_t item) {
    first[0] = item;
    const std::uint32_t length = last[0] > item ? last[0] - item : 0;
    are_short = others_are_short_ & (length <= 8);
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
  static std::uint64_t lowest(std::uint32_t length) { return 0xffu >> (8u - std::min(length, 8u)); }
  void add_beyond(std::uint32_t begin, std::uint32_t length) {
    others_are_short_ &= length <= 8 && count < kMost;
    if (!others_are_short_) return;
    first[count] = begin;
    items |= lowest(length) << (8 * count);
    ++count;
  }

  bool others_are_short_ = true;
};

}  // namespace scree::grid
