// Drift: how far bodies went since the list of neighbours was made.
#pragma once

#include <vector>

#include "slots.hpp"

namespace scree {
class Executor;
}  // namespace scree

namespace scree::dem {

/// Adds up the way of the fastest point of any body, which costs nothing, and only when that is too long looks where bodies are:
/// grains that rattle in their place go a long way and get nowhere.
class Drift {
 public:
  /// A list was made of the bodies as they are.
  void begin(const Slots& slots, const Executor& executor);
  /// In a sub-step no point of a body went farther than `way` [m]. Whether one may be more than `limit` [m] from where it was
  /// at begin(); also if that cannot be told.
  [[nodiscard]] bool exceeds(double limit, double way, const Slots& slots, const Executor& executor);

 private:
  [[nodiscard]] double farthest(const Slots& slots, const Executor& executor);

  /// A body whose points move by its turning, too.
  struct Turned {
    Slot slot = 0;
    Quat orientation = {};
  };
  std::vector<Place> place_;  // at begin()
  std::vector<Turned> turned_;
  std::vector<double> partial_;  // by chunk
  double used_ = 0.0;            // bound of the way of any point since begin() [m]
};

}  // namespace scree::dem
