#include "scree/simulation/step_backup.hpp"

#include <algorithm>
#include <span>

#include "scree/base/release.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kGrain = 4096;

template <class T>
void copy(std::span<const T> from, UninitialisedVector<T>& to, const Executor& executor) {
  make_room(from.size(), to);
  to.resize(from.size());
  executor.for_chunks(from.size(), kGrain, [&](std::size_t first, std::size_t last) {
    std::copy(from.data() + first, from.data() + last, to.data() + first);
  });
}

}  // namespace

void StepBackup::keep(const BodyStore& bodies, const Executor& executor) {
  const BodyView view = bodies.view();
  kept_ = true;
  copy(view.position, position_, executor);
  copy(view.orientation, orientation_, executor);
  copy(view.velocity, velocity_, executor);
  copy(view.angular_velocity, angular_velocity_, executor);
  attributes_.resize(bodies.attributes().count());
  for (AttributeId id = 0; id < attributes_.size(); ++id)
    copy(bodies.attributes().column(id), attributes_[id], executor);
}

void StepBackup::release_memory() {
  kept_ = false;
  if (position_.size() >= kManyRecords) *this = {};
}

void StepBackup::restore(BodyStore& bodies) const {
  if (!kept_) return;
  const BodyState state = bodies.state();
  std::ranges::copy(position_, state.position.begin());
  std::ranges::copy(orientation_, state.orientation.begin());
  std::ranges::copy(velocity_, state.velocity.begin());
  std::ranges::copy(angular_velocity_, state.angular_velocity.begin());
  for (AttributeId id = 0; id < attributes_.size(); ++id)
    std::ranges::copy(attributes_[id], bodies.attributes().column(id).begin());
}

}  // namespace scree
