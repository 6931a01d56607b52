#include "drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/parallel/executor.hpp"
#include "verlet.hpp"

namespace scree::dem {

void Drift::begin(const Slots& slots, const Executor& executor) {
  place_.resize(slots.size());
  executor.for_chunks(slots.size(), Verlet::kChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) place_[k] = slots.place[k];
  });
  turned_.clear();
  for (const Turning& t : slots.turning) turned_.push_back({t.slot, t.orientation});
  used_ = 0.0;
}

bool Drift::exceeds(double limit, double way, const Slots& slots, const Executor& executor) {
  used_ += way;
  if (used_ <= limit) return false;
  if (!std::isfinite(used_)) return true;
  used_ = farthest(slots, executor);
  return used_ > limit;
}

/// Of the points of all bodies [m]. Those that turn: the way of the centre and the chord of the point farthest from it.
double Drift::farthest(const Slots& slots, const Executor& executor) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (slots.size() != place_.size() || !std::ranges::equal(slots.turning, turned_, {}, &Turning::slot, &Turned::slot))
    return kUnknown;
  partial_.assign(Executor::chunk_count(slots.size(), Verlet::kChunk), 0.0);
  executor.for_chunks(slots.size(), Verlet::kChunk, [&](std::size_t first, std::size_t last) {
    double most = 0.0;
    for (std::size_t k = first; k < last; ++k)
      most = std::max(most, squared_norm(slots.place[k].position - place_[k].position));
    partial_[first / Verlet::kChunk] = std::sqrt(most);
  });
  double most = 0.0;
  for (const double part : partial_) most = std::max(most, part);
  for (std::size_t k = 0; k < turned_.size(); ++k) {
    const Turning& t = slots.turning[k];
    const Quat turn = t.orientation * conjugate(turned_[k].orientation);
    const double chord = 2.0 * slots.reach[k] * norm(Vec3{turn.x, turn.y, turn.z});
    most = std::max(most, norm(slots.place[t.slot].position - place_[t.slot].position) + chord);
  }
  return most;
}

}  // namespace scree::dem
