// FeedRecord: how much came in and went out, by material. Nothing vanishes: fed = in flight + removed.
#pragma once

#include <cstdint>
#include <vector>

#include "scree/model/body.hpp"

namespace scree {

/// A number of bodies and their mass.
struct Amount {
  std::uint64_t count = 0;
  double mass = 0.0;  ///< [kg]

  void add(double m) {
    ++count;
    mass += m;
  }
};

/// Sums over the run, one entry per material of the scene.
struct FeedRecord {
  std::vector<Amount> fed;
  std::vector<Amount> removed;
};

}  // namespace scree
