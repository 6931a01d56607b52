// NeighbourIndex: how well two classes are mixed, judged by who lies next to whom; it needs no grid.
//
// After Godlieb, Deen and Kuipers (2007), Characterizing solids mixing in DEM simulations, 6th Int. Conf. on Multiphase Flow
// (the nearest neighbours method, there for 12 neighbours and equal shares), for any shares:
//
//     M = U / (2 N1 N2 / (N (N - 1)))
//
// U is the share of neighbours that belong to the other class, over all particles; the denominator is its expectation when
// the classes are dealt at random. 0: no neighbour of the other class anywhere (in a bed parted by a plane, but for those
// at the plane); 1: random; above 1: ordered.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "analysis/classes.hpp"

namespace scree {

class Executor;

/// Who is a neighbour.
struct Neighbourhood {
  std::size_t nearest = 12;  ///< the nearest so many, by distance of the centres; 0: by `reach`
  double reach = 0.0;        ///< those at most `reach` times the sum of the radii away [1]
};

/// A particle that counts.
struct Placed {
  Vec3 position;        ///< [m]
  double radius = 0.0;  ///< [m]
  BodyClass of = BodyClass::first;
};

/// M, and the mean number of neighbours.
struct NeighbourIndex {
  double value = 0.0;         ///< M [1]; NaN when a class is empty or nobody has a neighbour
  double coordination = 0.0;  ///< neighbours per particle [1]
};

/// Every particle must be of the first or the second class. The same for any number of threads.
[[nodiscard]] NeighbourIndex neighbour_index(std::span<const Placed> particles, const Neighbourhood& rule,
                                             const Executor& executor);

}  // namespace scree
