// Drift: what bodies are expected to do while a list of neighbours is used, and how far they are from it.
#pragma once

#include <span>
#include <vector>

#include "scree/collision/collider.hpp"
#include "slots.hpp"

namespace scree {
class Executor;
}  // namespace scree

namespace scree::dem {

/// A list is good as long as bodies do as expected (ExpectedMotion), to half a skin. Each body is expected to fly on, or to stay
/// where it is, whichever came nearer to the truth under the last list: grains fall far and fast as foreseen, and those that
/// rattle in their place go a long way and get nowhere.
class Drift {
 public:
  /// A list is to be made of the bodies as they are. Nobody is expected to go farther than `farthest` [m].
  void begin(const Slots& slots, double farthest, const Executor& executor);
  /// Of those bodies, for the search.
  [[nodiscard]] ExpectedMotion expected(double skin) const { return {by_body_, horizon_, skin}; }
  /// A sub-step of `h` [s] in which no point of a body went farther than `way` [m] has passed. Whether one may be more than
  /// `limit` [m] from where it is expected; also if that cannot be told.
  [[nodiscard]] bool exceeds(double limit, double h, double way, const Slots& slots, const Executor& executor);
  /// The slots got other bodies.
  void forget() { bodies_.clear(); }

 private:
  [[nodiscard]] double farthest(const Slots& slots, const Executor& executor);

  /// Where a body was, and how fast it is expected to go on.
  struct Body {
    Vec3 place;     // [m]
    Vec3 velocity;  // [m/s]; zero: it is to stay
    Vec3 seen;      // the velocity it had [m/s]
  };
  /// One whose points move by its turning, too.
  struct Turned {
    Slot slot = 0;
    Quat orientation = {};
  };
  std::vector<Body> bodies_;   // by slot; empty where nothing is known
  std::vector<Vec3> by_body_;  // the velocities expected, as the scene numbers bodies [m/s]
  std::vector<Turned> turned_;
  std::vector<double> partial_;  // by chunk
  double horizon_ = 0.0;         // [s]
  double elapsed_ = 0.0;         // since begin() [s]
  double fastest_ = 0.0;         // of the velocities expected [m/s]
  double used_ = 0.0;            // bound of the way of any point from where it is expected [m]
};

}  // namespace scree::dem
