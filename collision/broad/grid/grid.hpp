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

#include "level.hpp"
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
  /// Pairs of a chunk, with room to write one more without asking.
  struct Pairs {
    std::vector<CandidatePair> buffer;
    std::size_t count = 0;
  };
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
  void search(std::size_t first, std::size_t last, Pairs& out) const;
  void search_level(const Item& item, const grid::Level& level, std::uint32_t begin, Pairs& out) const;
  void scan(const Item& item, std::uint32_t first, std::uint32_t last, Pairs& out) const;

  Vec3 origin_;
  std::vector<Item> items_;               // in the order of the BoxView
  std::vector<float> size_;               // longest edge [m]
  std::vector<std::uint32_t> histogram_;  // of sizes, eight bins an octave
  std::uint32_t first_bin_ = 0;           // of the finest level
  std::array<grid::Level, kLevels> levels_;
  std::size_t level_count_ = 0;
  std::vector<Extents> extents_;  // by chunk
  std::vector<std::uint32_t> item_cell_;
  std::vector<std::uint32_t> cell_begin_;  // first sorted item of each cell, and one more
  std::vector<Item> sorted_;
  std::vector<Pairs> chunk_pairs_;
};

}  // namespace scree
