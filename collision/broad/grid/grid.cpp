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
  items_.resize(n);
  size_.resize(n);
  executor.for_chunks(n, kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 lower = boxes.box[i].lower - origin_;
      const Vec3 upper = boxes.box[i].upper - origin_;
      Item& item = items_[i];
      item.lower = {rounded_down(lower.x), rounded_down(lower.y), rounded_down(lower.z)};
      item.minus_upper = {rounded_down(-upper.x), rounded_down(-upper.y), rounded_down(-upper.z)};
      item.box = static_cast<std::uint32_t>(i) | (boxes.movable[i] != 0 ? kMovable : 0u);
      item.owner = boxes.owner[i];
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
  extents_.resize(Executor::chunk_count(items_.size(), kBoxesPerChunk));
  executor.for_chunks(items_.size(), kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    Extents& extents = extents_[first / kBoxesPerChunk];
    extents.fill({{kHigh, kHigh, kHigh}, {kLow, kLow, kLow}, 0});
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t l = level_of(size_[i]);
      Extent& extent = extents[l];
      ++extent.boxes;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t cell = levels_[l].cell_of(centre(items_[i].lower[k], items_[i].minus_upper[k]));
        extent.lower[k] = std::min(extent.lower[k], cell);
        extent.upper[k] = std::max(extent.upper[k], cell);
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
  item_cell_.resize(items_.size());
  executor.for_chunks(items_.size(), kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const grid::Level& level = levels_[level_of(size_[i])];
      std::array<std::uint32_t, 3> at;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t cell = level.cell_of(centre(items_[i].lower[k], items_[i].minus_upper[k]));
        at[k] = level.axis[k].store(cell - level.axis[k].origin);
      }
      item_cell_[i] = level.index(at[0], at[1], at[2]);
    }
  });
  // Counting sort; counts land one place late, so that the scatter leaves the beginnings behind.
  for (const std::uint32_t cell : item_cell_) ++cell_begin_[cell + 2];
  for (std::size_t c = 2; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  sorted_.resize(items_.size());
  for (std::size_t i = 0; i < items_.size(); ++i) sorted_[cell_begin_[item_cell_[i] + 1]++] = items_[i];
}

/// `query` holds the upper corner, and minus the lower one, in the places of `item`'s lower and minus upper corner.
bool Grid::meets(const Item& query, const Item& item) {
#ifdef __AVX__
  const __m256 limit = _mm256_load_ps(query.lower.data());
  const __m256 corners = _mm256_load_ps(item.lower.data());
  // Six of the eight numbers are coordinates.
  return (_mm256_movemask_ps(_mm256_cmp_ps(corners, limit, _CMP_LE_OQ)) & 0x77) == 0x77;
#else
  bool meet = true;
  for (std::size_t k = 0; k < 3; ++k) {
    meet &= (item.lower[k] <= query.lower[k]) & (item.minus_upper[k] <= query.minus_upper[k]);
  }
  return meet;
#endif
}

void Grid::scan(const Item& item, std::uint32_t first, std::uint32_t last, Pairs& out) const {
  if (first >= last) return;
  if (out.buffer.size() < out.count + (last - first)) out.buffer.resize(2 * (out.count + (last - first)));
  Item query = item;
  for (std::size_t k = 0; k < 3; ++k) {
    query.lower[k] = -item.minus_upper[k];
    query.minus_upper[k] = -item.lower[k];
  }
  // Every pair is written, and overwritten by the next one unless it counts: a branch here would be guessed wrong often.
  CandidatePair* const pairs = out.buffer.data();
  std::size_t count = out.count;
  for (std::uint32_t k = first; k < last; ++k) {
    const Item& other = sorted_[k];
    pairs[count] = {item.box & ~kMovable, other.box & ~kMovable};
    count += meets(query, other) & (((item.box | other.box) & kMovable) != 0) & (item.owner != other.owner);
  }
  out.count = count;
}

void Grid::search_level(const Item& item, const grid::Level& level, std::uint32_t begin, Pairs& out) const {
  std::array<grid::CellRange, 3> range;
  for (std::size_t k = 0; k < 3; ++k) {
    range[k] = level.axis[k].clip(level.cell_of(double{item.lower[k]} - 0.5 * level.cell),
                                  level.cell_of(0.5 * level.cell - double{item.minus_upper[k]}));
    if (range[k].last < range[k].first) return;
  }
  const grid::LevelAxis& x_axis = level.axis[0];
  const std::uint32_t x0 = x_axis.store(range[0].first);
  const std::uint32_t x1 = x_axis.store(range[0].last);
  for (std::int32_t z = range[2].first; z <= range[2].last; ++z) {
    for (std::int32_t y = range[1].first; y <= range[1].last; ++y) {
      // Cells of a row follow each other, and so do their boxes.
      const std::uint32_t row = level.index(0, level.axis[1].store(y), level.axis[2].store(z));
      const auto scan_cells = [&](std::uint32_t from, std::uint32_t to) {
        scan(item, std::max(begin, cell_begin_[row + from]), cell_begin_[row + to + 1], out);
      };
      if (x0 <= x1) {
        scan_cells(x0, x1);
      } else {
        scan_cells(x0, static_cast<std::uint32_t>(x_axis.stored) - 1);
        scan_cells(0, x1);
      }
    }
  }
}

void Grid::search(std::size_t first, std::size_t last, Pairs& out) const {
  std::size_t own = 0;
  for (std::size_t i = first; i < last; ++i) {
    while (own + 1 < level_count_ && i >= cell_begin_[levels_[own + 1].first_cell]) ++own;
    const Item& item = sorted_[i];
    // Of two boxes of one level the first one finds the other.
    search_level(item, levels_[own], static_cast<std::uint32_t>(i + 1), out);
    for (std::size_t l = own + 1; l < level_count_; ++l) {
      if (levels_[l].boxes > 0) search_level(item, levels_[l], 0, out);
    }
  }
}

void Grid::find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) {
  if (boxes.size() < 2) return;
  copy_boxes(boxes, executor);
  choose_sizes();
  fit_levels(executor);
  sort_into_cells(executor);
  const std::size_t chunks = Executor::chunk_count(sorted_.size(), kSearchesPerChunk);
  if (chunk_pairs_.size() < chunks) chunk_pairs_.resize(chunks);
  executor.for_chunks(sorted_.size(), kSearchesPerChunk, [&](std::size_t first, std::size_t last) {
    Pairs& pairs = chunk_pairs_[first / kSearchesPerChunk];
    pairs.count = 0;
    search(first, last, pairs);
  });
  std::size_t total = out.size();
  for (std::size_t k = 0; k < chunks; ++k) total += chunk_pairs_[k].count;
  out.reserve(total);
  for (std::size_t k = 0; k < chunks; ++k) {
    const Pairs& pairs = chunk_pairs_[k];
    out.insert(out.end(), pairs.buffer.begin(), pairs.buffer.begin() + static_cast<std::ptrdiff_t>(pairs.count));
  }
}

void Grid::release_workspace() { release(items_, size_, extents_, item_cell_, cell_begin_, sorted_, chunk_pairs_); }

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::BroadPhase, scree::Grid>("grid", "Hierarchical grid: linear cost for sizes up to 1 to 10000.");
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("grid", "1.0.0", &list)};
