#include "grid.hpp"

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

/// True for planes and for what diverged: no number, larger than a planet, or so far that a double no longer tells what it touches.
/// One of these would make all other balls look alike. `far` [m]: the sum of its coordinates.
bool is_lost(double far, double radius) {
  constexpr double kLargest = 1e7;    // [m]
  constexpr double kFarthest = 1e15;  // in radii
  return !(radius <= kLargest && far <= kFarthest * radius);
}

double far_of(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// Radius of what meets nothing.
constexpr float kNowhere = -1.0f;

}  // namespace

Grid::Item Grid::item_of(const BoxView& boxes, std::size_t i, const Vec3& origin) {
  const Vec3 lower = boxes.box[i].lower - origin;
  const Vec3 upper = boxes.box[i].upper - origin;
  return {{rounded_down(lower.x), rounded_down(lower.y), rounded_down(lower.z)},
          static_cast<std::uint32_t>(i) | (boxes.movable[i] != 0 ? kMovable : 0u),
          {rounded_down(-upper.x), rounded_down(-upper.y), rounded_down(-upper.z)},
          boxes.owner[i]};
}

/// The middle box as origin: single precision is finest where the grains are.
bool Grid::choose_origin(const BoxView& boxes) {
  const std::size_t n = boxes.size();
  if (!balls_alone_) {
    origin_ = boxes.box[n / 2].lower;
    return true;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (n / 2 + k) % n;
    if (is_lost(far_of(boxes.ball[i].centre), boxes.ball[i].radius + boxes.margin[i])) continue;
    origin_ = boxes.ball[i].centre;
    return true;
  }
  return false;
}

grid::Ball Grid::spot_of_box(const BoxView& boxes, std::size_t i) const {
  const Item item = item_of(boxes, i, origin_);
  float size = 0.0f;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, -item.minus_upper[k] - item.lower[k]);
  const Vec3 middle = 0.5 * (boxes.box[i].lower + boxes.box[i].upper) - origin_;
  grid::Ball spot;
  spot.x = grid::rounded(middle.x);
  spot.y = grid::rounded(middle.y);
  spot.z = grid::rounded(middle.z);
  spot.r = 0.5f * std::min(size, 1e18f);
  return spot;
}

/// Places balls; returns where they lie. What lies nowhere counts as lying at the origin, where some ball is.
Grid::Extent Grid::place_balls(const BoxView& boxes, std::size_t first, std::size_t last) {
  Extent extent;
#ifdef __AVX2__
  static_assert(sizeof(BoundingBall) == 32 && sizeof(grid::Ball) == 16);
  const __m256d origin = _mm256_setr_pd(origin_.x, origin_.y, origin_.z, 0.0);
  const __m256d most = _mm256_set1_pd(grid::kFarthest), sign = _mm256_set1_pd(-0.0);
  __m128 lower = _mm_loadu_ps(extent.lower.data()), upper = _mm_loadu_ps(extent.upper.data());
  for (std::size_t i = first; i < last; ++i) {
    const __m256d centre = _mm256_sub_pd(_mm256_loadu_pd(&boxes.ball[i].centre.x), origin);
    const __m256d size = _mm256_andnot_pd(sign, centre);
    const __m128d xy = _mm256_castpd256_pd128(size), z = _mm256_extractf128_pd(size, 1);
    const double far = _mm_cvtsd_f64(_mm_add_sd(_mm_add_sd(xy, _mm_unpackhi_pd(xy, xy)), z));
    const double radius = boxes.ball[i].radius + boxes.margin[i];
    const __m256d near = _mm256_max_pd(_mm256_min_pd(centre, most), _mm256_xor_pd(sign, most));
    __m128 spot = _mm_insert_ps(_mm256_cvtpd_ps(near), _mm_set_ss(grid::Ball::grown(radius, far)), 0x30);
    if (is_lost(far, radius)) spot = _mm_setr_ps(0.0f, 0.0f, 0.0f, kNowhere);
    _mm_storeu_ps(&spots_[i].x, spot);
    lower = _mm_min_ps(spot, lower);
    upper = _mm_max_ps(spot, upper);
  }
  _mm_storeu_ps(extent.lower.data(), lower);
  _mm_storeu_ps(extent.upper.data(), upper);
#else
  for (std::size_t i = first; i < last; ++i) {
    const Vec3 centre = boxes.ball[i].centre - origin_;
    const double radius = boxes.ball[i].radius + boxes.margin[i];
    spots_[i] = {centre, radius};
    if (is_lost(far_of(centre), radius)) spots_[i].x = spots_[i].y = spots_[i].z = 0.0f, spots_[i].r = kNowhere;
    extent.add(spots_[i]);
  }
#endif
  return extent;
}

void Grid::place_boxes(const BoxView& boxes, const Executor& executor) {
  spots_.resize(boxes.size());
  extent_.resize(Executor::chunk_count(boxes.size(), kBoxesPerChunk));
  executor.for_chunks(boxes.size(), kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    Extent& extent = extent_[first / kBoxesPerChunk];
    if (balls_alone_) {
      extent = place_balls(boxes, first, last);
      return;
    }
    extent = {};
    for (std::size_t i = first; i < last; ++i) {
      spots_[i] = spot_of_box(boxes, i);
      extent.add(spots_[i]);
    }
  });
  for (std::size_t k = 1; k < extent_.size(); ++k) extent_[0].add(extent_[k]);
}

bool Grid::choose_sizes() {
  const float largest = 2.0f * extent_[0].upper[3];
  if (largest < 0.0f) return false;
  // What is smaller than this shares the finest level.
  const float smallest = std::ldexp(largest, -static_cast<int>(kLevels - 3));
  const std::uint32_t last = bin_of(largest);
  const std::uint32_t first = std::min(last, bin_of(std::max(smallest, std::numeric_limits<float>::min())));
  placed_ = 0;
  histogram_.assign(last - first + 1, 0);
  largest_.assign(last - first + 1, 0.0f);
  for (const grid::Ball& spot : spots_) {
    if (spot.r < 0.0f) continue;
    const std::uint32_t bin = std::max(bin_of(2.0f * spot.r), first) - first;
    ++histogram_[bin];
    ++placed_;
    largest_[bin] = std::max(largest_[bin], 2.0f * spot.r);
  }
  std::uint32_t bottom = first;  // the lowest bin with something in it
  while (histogram_[bottom - first] == 0) ++bottom;

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
      if (bin == bottom) break;
    }
    if (cost < best) {
      best = cost;
      first_bin_ = bottom - (bottom + kBinsPerOctave - shift) % kBinsPerOctave;
    }
  }
  level_count_ = (last - first_bin_) / kBinsPerOctave + 1;
  for (std::size_t l = 0; l < level_count_; ++l) {
    const std::uint32_t begin = first_bin_ + kBinsPerOctave * static_cast<std::uint32_t>(l);
    float widest = lower_edge_of(begin);
    for (std::uint32_t bin = std::max(begin, bottom); bin <= std::min(begin + kBinsPerOctave - 1, last); ++bin) {
      widest = std::max(widest, largest_[bin - first]);
    }
    levels_[l].cell = 1.0001 * double{widest};
    levels_[l].inverse_cell = 1.0 / levels_[l].cell;
  }
  return true;
}

std::size_t Grid::level_of(float size) const {
  return (std::max(bin_of(size), first_bin_) - first_bin_) / kBinsPerOctave;
}

/// The extents of the levels, into the first of extents_.
void Grid::measure_levels(const Executor& executor) {
  if (level_count_ == 1) {
    extents_.resize(1);
    extents_[0][0] = extent_[0];
    extents_[0][0].boxes = placed_;
    return;
  }
  extents_.resize(Executor::chunk_count(spots_.size(), kBoxesPerChunk));
  executor.for_chunks(spots_.size(), kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    Extents& extents = extents_[first / kBoxesPerChunk];
    std::fill_n(extents.begin(), level_count_, Extent{});
    for (std::size_t i = first; i < last; ++i) {
      if (spots_[i].r < 0.0f) continue;
      Extent& extent = extents[level_of(2.0f * spots_[i].r)];
      extent.add(spots_[i]);
      ++extent.boxes;
    }
  });
  for (std::size_t part = 1; part < extents_.size(); ++part) {
    for (std::size_t l = 0; l < level_count_; ++l) extents_[0][l].add(extents_[part][l]);
  }
}

void Grid::fit_levels(const Executor& executor) {
  measure_levels(executor);
  cells_ = 0;
  for (std::size_t l = 0; l < level_count_; ++l) {
    const Extent& whole = extents_[0][l];
    grid::Level& level = levels_[l];
    level.boxes = whole.boxes;
    level.first_cell = cells_;
    if (whole.boxes == 0) continue;
    std::array<std::int32_t, 3> lower, upper;
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = level.cell_of(double{whole.lower[k]});
      upper[k] = level.cell_of(double{whole.upper[k]});
    }
    level.fit(lower, upper);
    cells_ += level.cell_count();
  }
}

void Grid::sort_into_cells(const BoxView& boxes, const Executor& executor) {
  const std::size_t n = spots_.size();
  cell_.resize(n);
  executor.for_chunks(n, kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const grid::Ball& spot = spots_[i];
      if (spot.r < 0.0f) {
        cell_[i] = cells_;
      } else {
        cell_[i] = levels_[level_count_ == 1 ? 0 : level_of(2.0f * spot.r)].index_of(&spot.x);
      }
    }
  });
  // Counting sort; counts land one place late, so that the scatter leaves the beginnings behind.
  cell_begin_.assign(std::size_t{cells_} + 3, 0);
  for (const std::uint32_t cell : cell_) ++cell_begin_[std::size_t{cell} + 2];
  for (std::size_t c = 2; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
  order_.resize(n);
  for (std::size_t i = 0; i < n; ++i) order_[cell_begin_[std::size_t{cell_[i]} + 1]++] = static_cast<std::uint32_t>(i);
  balls_.resize(n);
  sorted_.resize(balls_alone_ ? 0 : n);
  executor.for_chunks(n, kBoxesPerChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      if (k + kPrefetch < last) __builtin_prefetch(&spots_[order_[k + kPrefetch]]);
      const std::size_t i = order_[k];
      if (balls_alone_) {
        balls_.set(k, spots_[i]);
        continue;
      }
      if (k + kPrefetch < last) __builtin_prefetch(&boxes.box[order_[k + kPrefetch]]);
      sorted_[k] = item_of(boxes, i, origin_);
      const Aabb& box = boxes.box[i];
      balls_.set(k, boxes.ball.empty()
                        ? grid::Ball{0.5 * (box.lower + box.upper) - origin_, 0.5 * norm(box.upper - box.lower)}
                        : grid::Ball{boxes.ball[i].centre - origin_, boxes.ball[i].radius + boxes.margin[i]});
    }
  });
}

void Grid::find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) {
  balls_alone_ = boxes.box.empty();
  if (boxes.size() < 2 || !choose_origin(boxes)) return;
  place_boxes(boxes, executor);
  if (!choose_sizes()) return;
  fit_levels(executor);
  sort_into_cells(boxes, executor);
  const std::size_t count = cell_begin_[cells_];  // of what lies somewhere
  const std::size_t chunks = Executor::chunk_count(count, kSearchesPerChunk);
  if (executor.threads() == 1) {
    found_.resize(std::max<std::size_t>(found_.size(), 1));
    for (std::size_t first = 0; first < count; first += kSearchesPerChunk) {
      const std::size_t last = std::min(first + kSearchesPerChunk, count);
      search(first, last, found_[0], out);
      // Room for the rest, as far as this can be told.
      if (first == 0) out.reserve(out.size() * count / last + count / 8);
    }
    return;
  }
  if (found_.size() < chunks) found_.resize(chunks);
  executor.for_chunks(count, kSearchesPerChunk, [&](std::size_t first, std::size_t last) {
    Found& found = found_[first / kSearchesPerChunk];
    found.pairs.clear();
    search(first, last, found, found.pairs);
  });
  std::size_t total = out.size();
  for (std::size_t k = 0; k < chunks; ++k) total += found_[k].pairs.size();
  out.reserve(total);
  for (std::size_t k = 0; k < chunks; ++k) out.insert(out.end(), found_[k].pairs.begin(), found_[k].pairs.end());
}

void Grid::release_workspace() {
  release(spots_, extent_, extents_, cell_, cell_begin_, order_, sorted_, found_);
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
