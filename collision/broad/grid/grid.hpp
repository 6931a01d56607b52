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
  /// What is sorted: an item and its ball, on one cache line, since the sort reads them in any order.
  struct alignas(64) Placed {
    Item item;
    grid::Ball ball;
    std::array<std::int32_t, 3> at;  // cell along each axis
    std::uint32_t cell;              // index
  };
  /// What the search of a chunk finds.
  struct Found {
    UninitialisedVector<grid::Balls::Near> near;
    std::size_t near_count = 0;
    UninitialisedVector<CandidatePair> pairs;
    std::size_t pair_count = 0;

    /// Room for so many more, and for a whole round of lanes.
    void make_room(std::size_t more) {
      if (near.size() < near_count + more + grid::Balls::kLanes) near.resize(2 * (near_count + more) + 64);
    }
  };
  static_assert(sizeof(Placed) == 64);
  static bool meets(const Item& query, const Item& item);
  static constexpr std::size_t kLevels = 40;
  /// Cells that the boxes of one level occupy, in one chunk.
  struct Extent {
    std::array<std::int32_t, 3> lower;
    std::array<std::int32_t, 3> upper;
    std::uint32_t boxes;
  };
  using Extents = std::array<Extent, kLevels>;

  void copy_boxes(const BoxView& boxes, const Executor& executor);
  void choose_sizes();
  void fit_levels(const Executor& executor);
  void sort_into_cells(const Executor& executor);
  [[nodiscard]] std::size_t level_of(float size) const;
  void search(std::size_t first, std::size_t last, Found& found) const;
  /// Rows of cells that hold what the items of one cell can meet and that come no earlier in the order.
  struct Rows {
    std::uint32_t cell = ~0u;
    std::array<std::uint32_t, 5> first,
        last;  // sorted items; the cell's own row begins anywhere before its items' ends
  };
  void find_rows(const grid::Level& level, std::uint32_t cell, Rows& rows) const;
  void search_rows(std::uint32_t i, const Rows& rows, Found& found) const;
  /// Looks for what item i can meet among the items from `begin` on in the cells of `level`.
  void search_level(std::uint32_t i, const grid::Level& level, std::uint32_t begin, Found& found) const;
  void keep_meeting(Found& found) const;

  Vec3 origin_;
  UninitialisedVector<Placed> placed_;    // in the order of the BoxView
  UninitialisedVector<float> size_;       // longest edge [m]
  std::vector<std::uint32_t> histogram_;  // of sizes, eight bins an octave
  std::uint32_t first_bin_ = 0;           // of the finest level
  std::array<grid::Level, kLevels> levels_;
  std::size_t level_count_ = 0;
  std::vector<Extents> extents_;              // by chunk
  std::vector<std::uint32_t> cell_begin_;     // first sorted item of each cell, and one more
  UninitialisedVector<std::uint32_t> order_;  // box of each sorted item
  UninitialisedVector<Item> sorted_;
  UninitialisedVector<std::uint32_t> sorted_cell_;
  grid::Balls balls_;         // of the sorted items
  std::vector<Found> found_;  // by chunk
};

}  // namespace scree
