// Broad phase `grid`: hierarchical grid, rebuilt every step in linear time.
//
// Levels differ by a factor of two in cell size; a box lies in the finest level
// whose cells hold it (Ogarko and Luding 2012, "A fast multilevel algorithm for
// contact detection of arbitrarily polydisperse objects"). Boxes of a level are
// compared with their neighbours of the same level and with the cells of coarser
// levels, never the other way: a drum beside a million grains costs one look-up a
// grain.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "balls.hpp"
#include "level.hpp"
#include "scree/base/uninitialised.hpp"
#include "scree/interfaces/broad_phase.hpp"

namespace scree {

/// Hierarchical grid. Keeps nothing between steps but memory.
class Grid : public BroadPhase {
 public:
  void find_pairs(const BoxView& boxes, const Executor& executor, std::vector<CandidatePair>& out) override;
  [[nodiscard]] bool takes_balls_alone() const override { return true; }
  void release_workspace() override;

 private:
  /// A box in single precision, rounded outwards, relative to origin_: half the
  /// memory to stream through. Upper corners are negated, so that two boxes are
  /// compared by one comparison of eight numbers, see meets() in the source.
  struct alignas(32) Item {
    std::array<float, 3> lower;        // [m]
    std::uint32_t box;                 // index in the BoxView; the top bit marks what can move
    std::array<float, 3> minus_upper;  // [m]
    std::uint32_t owner;
  };
  /// What the search of a chunk finds.
  struct Found {
    UninitialisedVector<CandidatePair> near;  // sorted items, or boxes where these are balls alone
    std::size_t near_count = 0;
    std::vector<CandidatePair> pairs;

    /// Room for so many more, and for a whole round of lanes.
    void make_room(std::size_t more) {
      if (near.size() < near_count + more + grid::Balls::kLanes) near.resize(2 * (near_count + more) + 64);
    }
  };
  static Item item_of(const BoxView& boxes, std::size_t i, const Vec3& origin);
  static bool meets(const Item& item, const Item& other);
  static bool are_wanted(const Item& item, const Item& other);
  static constexpr std::size_t kLevels = 40;
  static constexpr std::uint32_t kMovable = 0x80000000u;
  /// Where boxes lie, and how large they are: x, y, z and r [m].
  struct Extent {
    std::array<float, 4> lower, upper;
    std::uint32_t boxes = 0;

    Extent() {
      lower.fill(std::numeric_limits<float>::max());
      upper.fill(-std::numeric_limits<float>::max());
    }
    /// What is no number is left out.
    void add(const Extent& other) {
      for (std::size_t k = 0; k < 4; ++k) {
        lower[k] = other.lower[k] < lower[k] ? other.lower[k] : lower[k];
        upper[k] = other.upper[k] > upper[k] ? other.upper[k] : upper[k];
      }
      boxes += other.boxes;
    }
    void add(const grid::Ball& spot) {
      const std::array<float, 4> at{spot.x, spot.y, spot.z, spot.r};
      for (std::size_t k = 0; k < 4; ++k) {
        lower[k] = at[k] < lower[k] ? at[k] : lower[k];
        upper[k] = at[k] > upper[k] ? at[k] : upper[k];
      }
    }
  };
  using Extents = std::array<Extent, kLevels>;

  Extent place_balls(const BoxView& boxes, std::size_t first, std::size_t last);
  bool choose_origin(const BoxView& boxes);
  [[nodiscard]] grid::Ball spot_of_box(const BoxView& boxes, std::size_t i) const;
  void place_boxes(const BoxView& boxes, const Executor& executor);
  /// False when nothing lies anywhere.
  bool choose_sizes();
  void measure_levels(const Executor& executor);
  void fit_levels(const Executor& executor);
  void sort_into_cells(const BoxView& boxes, const Executor& executor);
  [[nodiscard]] std::size_t level_of(float size) const;
  void search(std::size_t first, std::size_t last, Found& found, std::vector<CandidatePair>& out) const;
  void find_rows(const grid::Level& level, std::uint32_t cell, grid::Rows& rows) const;
  void search_long_rows(std::uint32_t i, const grid::Rows& rows, Found& found) const;
  template <bool kNamed>
  void search_short_rows(std::uint32_t i, const grid::Rows& rows, Found& found) const;
  template <bool kNamed>
  void search_item(std::uint32_t i, std::size_t own, grid::Rows* rows, Found& found) const;
  void name_boxes(Found& found, std::size_t from) const;
  /// Looks for what item i can meet among the items from `begin` on in the cells of `level`.
  void search_level(std::uint32_t i, const grid::Level& level, std::uint32_t begin, Found& found) const;
  /// Appends those of found.near that meet to `out`.
  void keep_meeting(Found& found, std::vector<CandidatePair>& out) const;

  Vec3 origin_;
  bool balls_alone_ = false;
  /// By box: the middle, and half the longest edge [m]; negative for what lies nowhere. The ball, where there are no boxes.
  UninitialisedVector<grid::Ball> spots_;
  std::vector<std::uint32_t> histogram_;  // of sizes, eight bins an octave
  std::vector<float> largest_;            // size in each bin [m]
  std::uint32_t first_bin_ = 0;           // of the finest level
  std::array<grid::Level, kLevels> levels_;
  std::size_t level_count_ = 0;
  std::uint32_t placed_ = 0;                  // boxes that lie somewhere
  std::vector<Extent> extent_;                // by chunk; the first one, in the end, of all
  std::vector<Extents> extents_;              // by chunk, of several levels
  std::uint32_t cells_ = 0;                   // one more holds what lies nowhere
  UninitialisedVector<std::uint32_t> cell_;   // of each box
  std::vector<std::uint32_t> cell_begin_;     // first sorted item of each cell, and one more
  UninitialisedVector<std::uint32_t> order_;  // box of each sorted item
  UninitialisedVector<Item> sorted_;          // empty where there are no boxes
  grid::Balls balls_;                         // of the sorted items
  std::vector<Found> found_;                  // by chunk
};

}  // namespace scree
