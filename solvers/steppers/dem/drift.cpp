#include "drift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/parallel/executor.hpp"
#include "verlet.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kChunk = Verlet::kChunk;
/// A list is made for so many times what the one before was good for.
constexpr double kLonger = 2.0;

}  // namespace

void Drift::begin(const Slots& slots, double farthest, const Executor& executor) {
  const bool known = bodies_.size() == slots.size();
  bodies_.resize(slots.size()), by_body_.resize(slots.size());
  partial_.assign(Executor::chunk_count(slots.size(), kChunk), 0.0);
  executor.for_chunks(slots.size(), kChunk, [&](std::size_t first, std::size_t last) {
    double fastest2 = 0.0;
    for (std::size_t k = first; k < last; ++k) {
      Body& body = bodies_[k];
      const Vec3 now = slots.place[k].position, way = now - body.place, velocity = slots.moving[k].linear;
      const bool stays = known && squared_norm(way) < squared_norm(way - elapsed_ * body.seen);
      body = {.place = now, .velocity = stays ? Vec3{} : velocity, .seen = velocity};
      by_body_[slots.body[k]] = body.velocity;
      fastest2 = std::max(fastest2, squared_norm(body.velocity));
    }
    partial_[first / kChunk] = std::sqrt(fastest2);
  });
  fastest_ = 0.0;
  for (const double part : partial_) fastest_ = std::max(fastest_, part);
  turned_.clear();
  for (const Turning& t : slots.turning) turned_.push_back({t.slot, t.orientation});
  horizon_ = fastest_ > 0.0 ? std::min(kLonger * elapsed_, farthest / fastest_) : 0.0;
  elapsed_ = used_ = 0.0;
}

bool Drift::exceeds(double limit, double h, double way, const Slots& slots, const Executor& executor) {
  used_ += way + std::min(h, std::max(0.0, horizon_ - elapsed_)) * fastest_;
  elapsed_ += h;
  if (used_ <= limit) return false;
  if (!std::isfinite(used_)) return true;
  used_ = this->farthest(slots, executor);
  return used_ > limit;
}

/// Of the points of all bodies [m]. Those that turn: the way of the centre and the chord of the point farthest from it.
double Drift::farthest(const Slots& slots, const Executor& executor) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (slots.size() != bodies_.size() ||
      !std::ranges::equal(slots.turning, turned_, {}, &Turning::slot, &Turned::slot)) {
    return kUnknown;
  }
  const double passed = std::min(elapsed_, horizon_);
  const auto way2 = [&](std::size_t k) {
    return squared_norm(slots.place[k].position - bodies_[k].place - passed * bodies_[k].velocity);
  };
  partial_.assign(Executor::chunk_count(slots.size(), kChunk), 0.0);
  executor.for_chunks(slots.size(), kChunk, [&](std::size_t first, std::size_t last) {
    double most = 0.0;
    for (std::size_t k = first; k < last; ++k) most = std::max(most, way2(k));
    partial_[first / kChunk] = std::sqrt(most);
  });
  double most = 0.0;
  for (const double part : partial_) most = std::max(most, part);
  for (std::size_t k = 0; k < turned_.size(); ++k) {
    const Turning& t = slots.turning[k];
    const Quat turn = t.orientation * conjugate(turned_[k].orientation);
    const double chord = 2.0 * slots.reach[k] * norm(Vec3{turn.x, turn.y, turn.z});
    most = std::max(most, std::sqrt(way2(t.slot)) + chord);
  }
  return most;
}

}  // namespace scree::dem
