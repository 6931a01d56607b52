// Kernel: the weight with which a grain counts at a distance, and its place among the cells of a grid.
//
// Width w, range R, distance r:
//
//     lucy       (1 + 3 r / R) (1 - r / R)^3           R = 2 w      (Lucy 1977, Astron. J. 82, 1013; width as in Weinhart,
//                                                                   Hartkamp, Thornton and Luding 2013, Phys. Fluids 25, 070605)
//     gaussian   exp(-r^2 / (2 w^2))                   R = 3 w      cut there
//
// Not normalised here: the weights of a grain are divided by their sum over all cells of the grid, continued without end, so
// that a grain whose range lies within the grid leaves there exactly what it has. What reaches beyond the grid is lost to it,
// as it should be.
#pragma once

#include <array>

#include "analysis/region.hpp"

namespace scree {

enum class KernelKind { lucy, gaussian };

/// The weight as a function of distance.
class Kernel {
 public:
  /// `width` [m] > 0.
  Kernel(KernelKind kind, double width);
  [[nodiscard]] double operator()(double squared_distance) const;  ///< [m2] -> [1]
  [[nodiscard]] double range() const { return range_; }            ///< [m]

 private:
  KernelKind kind_;
  double range_;          // [m]
  double squared_range_;  // [m2]
  double per_squared_;    // gaussian: 1 / (2 w^2) [1/m2]
};

/// Cells first..last-1 along each axis; may lie outside of the grid.
struct CellRange {
  std::array<long, 3> first{}, last{};
};

/// The centres of the cells of a grid in the world, continued without end.
class Lattice {
 public:
  explicit Lattice(const CellGrid& grid);

  [[nodiscard]] Vec3 centre(long x, long y, long z) const;  ///< [m]
  /// The cells whose centres may lie within `range` [m] of a place [m].
  [[nodiscard]] CellRange around(const Vec3& place, double range) const;
  /// The part of a range that lies in the grid.
  [[nodiscard]] CellRange within_grid(CellRange cells) const;
  /// One over the sum of the kernel over all cells [1]; 0 where no cell is reached, and for places whose range misses the grid.
  [[nodiscard]] double normalisation(const Kernel& kernel, const Vec3& place) const;
  [[nodiscard]] const std::array<long, 3>& count() const { return count_; }
  [[nodiscard]] std::size_t index(long x, long y, long z) const {
    return static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x);
  }

 private:
  Vec3 origin_;   // lower corner [m]
  Vec3 spacing_;  // [m]
  std::array<long, 3> count_{};
};

}  // namespace scree
