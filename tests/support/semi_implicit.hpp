// The semi-implicit scheme that scree's trajectories are compared with, on its own: v += h a(x, v), x += h v.
#pragma once

#include <array>
#include <cmath>

#include "scree/math/vec3.hpp"

namespace scree::test {

/// A point in flight.
struct Flight {
  Vec3 position;      ///< [m]
  Vec3 velocity;      ///< [m/s]
  double time = 0.0;  ///< [s]
};

/// One step of `h` [s]; `acceleration(flight)` returns [m/s2].
template <class Acceleration>
void advance_flight(Flight& flight, double h, Acceleration&& acceleration) {
  flight.velocity += h * acceleration(flight);
  flight.position += h * flight.velocity;
  flight.time += h;
}

/// Values of one quantity computed with the steps 1, 0.5 and 0.25 ms.
using ThreeSteps = std::array<double, 3>;
inline constexpr ThreeSteps kThreeSteps{1e-3, 0.5e-3, 0.25e-3};  ///< [s]

/// The values extrapolated to h = 0: exact when the error is c1 h + c2 h^2 (Richardson).
inline double extrapolated(const ThreeSteps& value) {
  const double first = 2.0 * value[1] - value[0];
  const double second = 2.0 * value[2] - value[1];
  return (4.0 * second - first) / 3.0;
}

/// The order of convergence that the last halving of the step shows against `exact`.
inline double observed_order(const ThreeSteps& value, double exact) {
  return std::log2(std::abs(value[1] - exact) / std::abs(value[2] - exact));
}

}  // namespace scree::test
