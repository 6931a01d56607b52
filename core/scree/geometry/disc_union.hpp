// Unions of discs in a plane: area and moments, exactly, from the arcs of the boundary.
#pragma once

#include <span>
#include <vector>

namespace scree {

/// A disc in the plane of a slice.
struct Disc {
  double x = 0.0;       ///< [m]
  double y = 0.0;       ///< [m]
  double radius = 0.0;  ///< [m], positive
};

/// Integrals over a region of the plane.
struct PlanarMoments {
  double area = 0.0;  ///< [m^2]
  double x = 0.0;     ///< integral of x dA [m^3]
  double y = 0.0;     ///< integral of y dA [m^3]
  double xx = 0.0;    ///< integral of x^2 dA [m^4]
  double xy = 0.0;    ///< integral of x y dA [m^4]
  double yy = 0.0;    ///< integral of y^2 dA [m^4]
};

/// Integrates over unions of discs; keeps its workspace between calls.
class DiscUnion {
 public:
  /// Area [m^2] and moments of the union of the discs, exact up to rounding. Cost O(n^2 log n).
  [[nodiscard]] PlanarMoments moments(std::span<const Disc> discs);

 private:
  struct Arc {
    double begin, end;  ///< angles [rad] within [0, 2 pi]
  };
  /// Fills covered_ with the angles of disc i that lie in other discs; false when all of it does.
  bool find_covered(std::span<const Disc> discs, std::size_t i);

  std::vector<Arc> covered_;
};

}  // namespace scree
