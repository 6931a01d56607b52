// The search of `grid`: who is near whom, and who of these meets.
#ifdef __AVX__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>

#include "grid.hpp"

namespace scree {
namespace {

/// What is near is looked at more closely so many pairs at a time.
constexpr std::size_t kNear = 1024;

}  // namespace

/// True when the lower corner of neither lies beyond the upper one of the other.
bool Grid::meets(const Item& item, const Item& other) {
#ifdef __AVX__
  // lower + (minus_upper of the other) <= 0 would round: halves are exchanged and signs turned instead.
  const __m256 corners = _mm256_load_ps(item.lower.data());
  const __m256 exchanged = _mm256_permute2f128_ps(corners, corners, 1);
  const __m256 limit = _mm256_xor_ps(exchanged, _mm256_set1_ps(-0.0f));
  // Six of the eight numbers are coordinates.
  return (_mm256_movemask_ps(_mm256_cmp_ps(_mm256_load_ps(other.lower.data()), limit, _CMP_LE_OQ)) & 0x77) == 0x77;
#else
  bool meet = true;
  for (std::size_t k = 0; k < 3; ++k) {
    meet &= (other.lower[k] <= -item.minus_upper[k]) & (other.minus_upper[k] <= -item.lower[k]);
  }
  return meet;
#endif
}

/// True when two boxes meet that belong to two owners and can move, one at least.
bool Grid::are_wanted(const Item& item, const Item& other) {
  return meets(item, other) & (((item.box | other.box) & kMovable) != 0) & (item.owner != other.owner);
}

void Grid::keep_meeting(Found& found, std::vector<CandidatePair>& out) const {
  if (balls_alone_) {
    // These are boxes already, and wanted.
    out.insert(out.end(), found.near.begin(), found.near.begin() + static_cast<std::ptrdiff_t>(found.near_count));
    found.near_count = 0;
    return;
  }
  std::array<CandidatePair, 128> batch;
  for (std::size_t first = 0; first < found.near_count; first += batch.size()) {
    const std::size_t last = std::min(first + batch.size(), found.near_count);
    // Every pair is written, and overwritten by the next one unless it counts: a branch here would be guessed wrong often.
    std::size_t count = 0;
    for (std::size_t k = first; k < last; ++k) {
      const auto [one, other] = found.near[k];
      batch[count] = {order_[one], order_[other]};
      count += are_wanted(sorted_[one], sorted_[other]);
    }
    out.insert(out.end(), batch.begin(), batch.begin() + static_cast<std::ptrdiff_t>(count));
  }
  found.near_count = 0;
}

/// Items become boxes, from a place on.
void Grid::name_boxes(Found& found, std::size_t from) const {
  for (std::size_t k = from; k < found.near_count; ++k) {
    found.near[k] = {order_[found.near[k].a], order_[found.near[k].b]};
  }
}

void Grid::search_level(std::uint32_t i, const grid::Level& level, std::uint32_t begin, Found& found) const {
  std::array<float, 3> lower, upper;
  if (balls_alone_) {
    const grid::Ball ball = balls_[i];
    lower = {ball.x - ball.r, ball.y - ball.r, ball.z - ball.r};
    upper = {ball.x + ball.r, ball.y + ball.r, ball.z + ball.r};
  } else {
    lower = sorted_[i].lower;
    for (std::size_t k = 0; k < 3; ++k) upper[k] = -sorted_[i].minus_upper[k];
  }
  std::array<grid::CellRange, 3> range;
  for (std::size_t k = 0; k < 3; ++k) {
    range[k] = level.axis[k].clip(level.cell_of(double{lower[k]} - 0.5 * level.cell),
                                  level.cell_of(double{upper[k]} + 0.5 * level.cell));
    if (range[k].last < range[k].first) return;
  }
  const grid::LevelAxis& x_axis = level.axis[0];
  const std::uint32_t x0 = x_axis.store(range[0].first);
  const std::uint32_t x1 = x_axis.store(range[0].last);
  const auto scan = [&](std::uint32_t row, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t first = std::max(cell_begin_[row + from], begin), last = cell_begin_[row + to + 1];
    if (first >= last) return;
    found.make_room(last - first);
    found.near_count += balls_.meeting(i, first, last, &found.near[found.near_count]);
  };
  for (std::int32_t z = range[2].first; z <= range[2].last; ++z) {
    for (std::int32_t y = range[1].first; y <= range[1].last; ++y) {
      // Cells of a row follow each other, and so do their boxes.
      const std::uint32_t row = level.index(0, level.axis[1].store(y), level.axis[2].store(z));
      if (x0 <= x1) {
        scan(row, x0, x1);
      } else {
        scan(row, x0, static_cast<std::uint32_t>(x_axis.stored) - 1);
        scan(row, 0, x1);
      }
    }
  }
}

/// Behind each line and plane of cells lies an empty one, so nothing has to be asked of where the level ends.
void Grid::find_rows(const grid::Level& level, std::uint32_t cell, grid::Rows& rows) const {
  const auto [width, depth, height] = level.stored();
  const std::size_t line = width, plane = std::size_t{width} * depth;
  const std::uint32_t* const begin = cell_begin_.data() + cell;
  rows.clear();
  rows.last[0] = begin[2];
  const auto set = [&](std::size_t k, std::size_t ahead) { rows.set(k, begin[ahead - 1], begin[ahead + 2]); };
  set(1, line);
  set(2, plane - line);
  set(3, plane);
  set(4, plane + line);
}

void Grid::search_long_rows(std::uint32_t i, const grid::Rows& rows, Found& found) const {
  for (std::size_t row = 0; row < rows.last.size(); ++row) {
    found.near_count += balls_.meeting(i, rows.first[row], rows.last[row], &found.near[found.near_count]);
  }
}

template <bool kNamed>
void Grid::search_short_rows(std::uint32_t i, const grid::Rows& rows, Found& found) const {
  std::uint64_t meet = balls_.meeting_short(i, rows);
  const auto count = static_cast<std::size_t>(std::popcount(meet));
  CandidatePair* const near = &found.near[found.near_count];
  const std::uint32_t* const order = order_.data();
  const std::uint32_t one = kNamed ? order[i] : i;
  const auto write_next = [&](CandidatePair& place) {
    const std::uint32_t other = rows.item(static_cast<unsigned>(std::countr_zero(meet)));
    place = {one, kNamed ? order[other] : other};
    meet &= meet - 1;
  };
  // Few have more than four, which are written without a look at how many there are.
  for (std::size_t n = 0; n < 4; ++n) write_next(near[n]);
  for (std::size_t n = 4; n < count; ++n) write_next(near[n]);
  found.near_count += count;
}

/// Looks for what item i can meet in the rows round its cell and among the coarser levels.
template <bool kNamed>
void Grid::search_item(std::uint32_t i, std::size_t own, grid::Rows* rows, Found& found) const {
  std::size_t before = found.near_count;
  // Of two boxes of one level the first one finds the other.
  if (rows == nullptr) {
    search_level(i, levels_[own], i + 1, found);
  } else {
    rows->begin_at(i + 1);
    if (rows->are_short) {
      search_short_rows<kNamed>(i, *rows, found);
      before = found.near_count;
    } else {
      search_long_rows(i, *rows, found);
    }
  }
  for (std::size_t l = own + 1; l < level_count_; ++l) {
    if (levels_[l].boxes > 0) search_level(i, levels_[l], 0, found);
  }
  if (kNamed) name_boxes(found, before);
}

void Grid::search(std::size_t first, std::size_t last, Found& found, std::vector<CandidatePair>& out) const {
  found.near_count = 0;
  const auto at = std::upper_bound(cell_begin_.begin(), cell_begin_.end(), static_cast<std::uint32_t>(first));
  auto cell = static_cast<std::uint32_t>(at - cell_begin_.begin()) - 1;
  std::size_t own = 0;
  grid::Rows known;
  for (auto i = static_cast<std::uint32_t>(first); i < last; ++cell) {
    const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(cell_begin_[std::size_t{cell} + 1], last));
    if (i >= end) continue;
    while (own + 1 < level_count_ && cell >= levels_[own + 1].first_cell) ++own;
    grid::Rows* const rows = levels_[own].is_wrapped() ? nullptr : &known;
    if (rows != nullptr) find_rows(levels_[own], cell, known);
    const std::size_t most = rows != nullptr ? rows->count_from(i) : 0;
    for (; i < end; ++i) {
      found.make_room(most);
      if (balls_alone_) {
        search_item<true>(i, own, rows, found);
      } else {
        search_item<false>(i, own, rows, found);
      }
      // While they are in the cache.
      if (found.near_count >= kNear) keep_meeting(found, out);
    }
  }
  keep_meeting(found, out);
}

}  // namespace scree
