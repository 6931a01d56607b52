#include "grid.hpp"

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <bit>
#include <cmath>
#include <limits>

#include "scree/base/release.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kBoxesPerChunk = 8192;
constexpr std::size_t kSearchesPerChunk = 4096;
constexpr std::uint32_t kMovable = 0x80000000u;
/// Items ahead of the present one that are fetched into the cache.
constexpr std::size_t kPrefetch = 16;
constexpr std::uint32_t kBinsPerOctave = 8;

/// Sizes by their leading bits: eight bins between powers of two, growing with the size.
std::uint32_t bin_of(float size) { return std::bit_cast<std::uint32_t>(size) >> 20; }
float lower_edge_of(std::uint32_t bin) { return std::bit_cast<float>(bin << 20); }

/// Rounded down by more than the conversion to float can err.
float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return f - (std::abs(f) * 2.5e-7f + std::numeric_limits<float>::min());
}

double centre(float lower, float minus_upper) { return 0.5 * (double{lower} - double{minus_upper}); }

}  // namespace

void Grid::copy_boxes(const BoxView& boxes, const Executor& executor) {
  const std::size_t n = boxes.size();
  // The middle box as origin: single precision is finest where the grains are.
  origin_ = boxes.box[n / 2].lower;
  placed_.resize(n);
  size_.resize(n);
  executor.for_chunks(n, kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 lower = boxes.box[i].lower - origin_;
      const Vec3 upper = boxes.box[i].upper - origin_;
      Placed& placed = placed_[i];
      Item& item = placed.item;
      item.lower = {rounded_down(lower.x), rounded_down(lower.y), rounded_down(lower.z)};
      item.minus_upper = {rounded_down(-upper.x), rounded_down(-upper.y), rounded_down(-upper.z)};
      item.box = static_cast<std::uint32_t>(i) | (boxes.movable[i] != 0 ? kMovable : 0u);
      item.owner = boxes.owner[i];
      placed.ball = boxes.ball.empty() ? grid::Ball{0.5 * (lower + upper), 0.5 * norm(upper - lower)}
                                       : grid::Ball{boxes.ball[i].centre - origin_, boxes.ball[i].radius};
      size_[i] = 0.0f;
      for (std::size_t k = 0; k < 3; ++k) size_[i] = std::max(size_[i], -item.minus_upper[k] - item.lower[k]);
    }
  });
}

void Grid::choose_sizes() {
  const float largest = *std::max_element(size_.begin(), size_.end());
  // What is smaller than this shares the finest level.
  const float smallest = std::ldexp(largest, -static_cast<int>(kLevels - 3));
  const std::uint32_t last = bin_of(largest);
  const std::uint32_t first = std::min(last, bin_of(std::max(smallest, std::numeric_limits<float>::min())));
  histogram_.assign(last - first + 1, 0);
  for (const float s : size_) ++histogram_[std::max(bin_of(s), first) - first];

  // Levels are octaves; where the octaves begin is free. Cost of a box: cells that are larger than it hold more
  // neighbours, and each populated coarser level is searched too.
  double best = std::numeric_limits<double>::infinity();
  for (std::uint32_t shift = 0; shift < kBinsPerOctave; ++shift) {
    double cost = 0.0;
    double coarser = -1.0;
    std::uint32_t level = std::numeric_limits<std::uint32_t>::max();
    for (std::uint32_t bin = last;; --bin) {
      const std::uint32_t count = histogram_[bin - first];
      const std::uint32_t place = bin + kBinsPerOctave - shift;
      if (count > 0 && place / kBinsPerOctave != level) {
        level = place / kBinsPerOctave;
        coarser += 1.0;
      }
      const std::uint32_t below_edge = kBinsPerOctave - 1 - place % kBinsPerOctave;
      cost += count * (std::exp2(3.0 * below_edge / kBinsPerOctave) + coarser);
      if (bin == first) break;
    }
    if (cost < best) {
      best = cost;
      first_bin_ = first - (first + kBinsPerOctave - shift) % kBinsPerOctave;
    }
  }
  level_count_ = (last - first_bin_) / kBinsPerOctave + 1;
  for (std::size_t l = 0; l < level_count_; ++l) {
    const auto next = first_bin_ + kBinsPerOctave * static_cast<std::uint32_t>(l + 1);
    levels_[l].cell = 1.0001 * double{lower_edge_of(next)};
    levels_[l].inverse_cell = 1.0 / levels_[l].cell;
  }
}

std::size_t Grid::level_of(float size) const {
  return (std::max(bin_of(size), first_bin_) - first_bin_) / kBinsPerOctave;
}

void Grid::fit_levels(const Executor& executor) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();
  extents_.resize(Executor::chunk_count(placed_.size(), kBoxesPerChunk));
  executor.for_chunks(placed_.size(), kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    Extents& extents = extents_[first / kBoxesPerChunk];
    extents.fill({{kHigh, kHigh, kHigh}, {kLow, kLow, kLow}, 0});
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t l = level_of(size_[i]);
      Extent& extent = extents[l];
      ++extent.boxes;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t cell = levels_[l].cell_of(centre(placed_[i].item.lower[k], placed_[i].item.minus_upper[k]));
        extent.lower[k] = std::min(extent.lower[k], cell);
        extent.upper[k] = std::max(extent.upper[k], cell);
        placed_[i].at[k] = cell;
      }
    }
  });
  std::uint32_t cells = 0;
  for (std::size_t l = 0; l < level_count_; ++l) {
    Extent whole = extents_[0][l];
    for (const Extents& part : extents_) {
      for (std::size_t k = 0; k < 3; ++k) {
        whole.lower[k] = std::min(whole.lower[k], part[l].lower[k]);
        whole.upper[k] = std::max(whole.upper[k], part[l].upper[k]);
      }
      if (&part != &extents_[0]) whole.boxes += part[l].boxes;
    }
    levels_[l].boxes = whole.boxes;
    levels_[l].first_cell = cells;
    if (whole.boxes == 0) continue;
    levels_[l].fit(whole.lower, whole.upper);
    cells += levels_[l].cell_count();
  }
  cell_begin_.assign(std::size_t{cells} + 2, 0);
}

void Grid::sort_into_cells(const Executor& executor) {
  executor.for_chunks(placed_.size(), kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const grid::Level& level = levels_[level_of(size_[i])];
      std::array<std::uint32_t, 3> at;
      for (std::size_t k = 0; k < 3; ++k) {
        at[k] = level.axis[k].store(placed_[i].at[k] - level.axis[k].origin);
      }
      placed_[i].cell = level.index(at[0], at[1], at[2]);
    }
  });
  // Counting sort; counts land one place late, so that the scatter leaves the beginnings behind.
  for (const Placed& placed : placed_) ++cell_begin_[placed.cell + 2];
  for (std::size_t c = 2; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  const std::size_t n = placed_.size();
  order_.resize(n);
  for (std::size_t i = 0; i < n; ++i) order_[cell_begin_[placed_[i].cell + 1]++] = static_cast<std::uint32_t>(i);
  sorted_.resize(n);
  sorted_cell_.resize(n);
  balls_.resize(n);
  executor.for_chunks(n, kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      if (k + kPrefetch < last) __builtin_prefetch(&placed_[order_[k + kPrefetch]]);
      const Placed& placed = placed_[order_[k]];
      sorted_[k] = placed.item;
      sorted_cell_[k] = placed.cell;
      balls_.set(k, placed.ball);
    }
  });
}

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

void Grid::keep_meeting(Found& found) const {
  found.pairs.resize(found.near_count + 1);
  // Every pair is written, and overwritten by the next one unless it counts: a branch here would be guessed wrong often.
  CandidatePair* const pairs = found.pairs.data();
  std::size_t count = 0;
  for (std::size_t k = 0; k < found.near_count; ++k) {
    const Item& item = sorted_[found.near[k].one];
    const Item& other = sorted_[found.near[k].other];
    pairs[count] = {item.box & ~kMovable, other.box & ~kMovable};
    count += meets(item, other) & (((item.box | other.box) & kMovable) != 0) & (item.owner != other.owner);
  }
  found.pair_count = count;
}

void Grid::search_level(std::uint32_t i, const grid::Level& level, std::uint32_t begin, Found& found) const {
  const Item& item = sorted_[i];
  std::array<grid::CellRange, 3> range;
  for (std::size_t k = 0; k < 3; ++k) {
    range[k] = level.axis[k].clip(level.cell_of(double{item.lower[k]} - 0.5 * level.cell),
                                  level.cell_of(0.5 * level.cell - double{item.minus_upper[k]}));
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

void Grid::find_rows(const grid::Level& level, std::uint32_t cell, Rows& rows) const {
  rows.cell = cell;
  const auto width = static_cast<std::uint32_t>(level.axis[0].stored);
  const auto depth = static_cast<std::uint32_t>(level.axis[1].stored);
  const auto height = static_cast<std::uint32_t>(level.axis[2].stored);
  const std::uint32_t x = (cell - level.first_cell) % width;
  const std::uint32_t y = (cell - level.first_cell) / width % depth;
  const std::uint32_t z = (cell - level.first_cell) / width / depth;
  const std::uint32_t x0 = x > 0 ? x - 1 : 0, x1 = std::min(x + 1, width - 1);
  const auto set = [&](std::size_t k, std::uint32_t row_y, std::uint32_t row_z, bool exists) {
    rows.first[k] = exists ? cell_begin_[level.index(k == 0 ? x : x0, row_y, row_z)] : 0;
    rows.last[k] = exists ? cell_begin_[level.index(x1, row_y, row_z) + 1] : 0;
  };
  set(0, y, z, true);
  set(1, y + 1, z, y + 1 < depth);
  const bool above = z + 1 < height;
  set(2, y - 1, z + 1, above && y > 0);
  set(3, y, z + 1, above);
  set(4, y + 1, z + 1, above && y + 1 < depth);
}

void Grid::search_rows(std::uint32_t i, const Rows& rows, Found& found) const {
  std::size_t most = 0;
  for (std::size_t k = 0; k < 5; ++k) most += rows.last[k] - rows.first[k];
  found.make_room(most);
  grid::Balls::Near* near = &found.near[found.near_count];
  near += balls_.meeting(i, i + 1, rows.last[0], near);
  for (std::size_t k = 1; k < 5; ++k) near += balls_.meeting(i, rows.first[k], rows.last[k], near);
  found.near_count = static_cast<std::size_t>(near - found.near.data());
}

void Grid::search(std::size_t first, std::size_t last, Found& found) const {
  found.near_count = 0;
  found.make_room(4 * (last - first));
  std::size_t own = 0;
  Rows rows;
  for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) {
    while (own + 1 < level_count_ && i >= cell_begin_[levels_[own + 1].first_cell]) ++own;
    const grid::Level& level = levels_[own];
    // Of two boxes of one level the first one finds the other.
    if (level.is_wrapped()) {
      search_level(i, level, i + 1, found);
    } else {
      if (sorted_cell_[i] != rows.cell) find_rows(level, sorted_cell_[i], rows);
      search_rows(i, rows, found);
    }
    for (std::size_t l = own + 1; l < level_count_; ++l) {
      if (levels_[l].boxes > 0) search_level(i, levels_[l], 0, found);
    }
  }
  keep_meeting(found);
}

void Grid::find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) {
  if (boxes.size() < 2) return;
  copy_boxes(boxes, executor);
  choose_sizes();
  fit_levels(executor);
  sort_into_cells(executor);
  const std::size_t chunks = Executor::chunk_count(sorted_.size(), kSearchesPerChunk);
  if (found_.size() < chunks) found_.resize(chunks);
  executor.for_chunks(sorted_.size(), kSearchesPerChunk, [&](std::size_t first, std::size_t last) {
    search(first, last, found_[first / kSearchesPerChunk]);
  });
  std::size_t total = out.size();
  for (std::size_t k = 0; k < chunks; ++k) total += found_[k].pair_count;
  out.reserve(total);
  for (std::size_t k = 0; k < chunks; ++k) {
    const auto begin = found_[k].pairs.begin();
    out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(found_[k].pair_count));
  }
}

void Grid::release_workspace() {
  release(placed_, size_, extents_, cell_begin_, order_, sorted_, sorted_cell_, found_);
  balls_.release();
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::BroadPhase, scree::Grid>("grid", "Hierarchical grid: linear cost for sizes up to 1 to 10000.");
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("grid", "1.0.0", &list)};
