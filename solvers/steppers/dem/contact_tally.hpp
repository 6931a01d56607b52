// ContactTally: what an evaluation counts of its contacts.
#pragma once

#include <algorithm>
#include <cstddef>

namespace scree::dem {

struct ContactTally {
  std::size_t closed = 0;         ///< contacts that overlap
  double relative_overlap = 0.0;  ///< sum over them, each over the smaller moving radius [1]
  double greatest_overlap = 0.0;  ///< [m]
  double belt_work = 0.0;         ///< by surfaces that move against their bodies [J]

  void add(double overlap, double smaller_radius) {
    ++closed;
    relative_overlap += overlap / smaller_radius;
  }
  ContactTally& operator+=(const ContactTally& o) {
    closed += o.closed;
    relative_overlap += o.relative_overlap;
    greatest_overlap = std::max(greatest_overlap, o.greatest_overlap);
    belt_work += o.belt_work;
    return *this;
  }
};

}  // namespace scree::dem
