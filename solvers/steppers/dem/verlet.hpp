// Velocity Verlet with forces that depend on velocities (Verlet 1967, Swope et al. 1982; predicted velocities as in
// Allen & Tildesley, Computer Simulation of Liquids):
//
//     v(t + h/2) = v + h/2 a          x += h v(t + h/2)
//     forces at x(t + h) and the predicted velocity v(t + h/2) + h/2 a
//     v(t + h) = v(t + h/2) + h/2 a(t + h)
//
// Between two outer steps the state is whole: forces are asked for again at the beginning of each. Bodies with three moments
// keep their angular momentum; their orientation goes by the midpoint rule with it.
#pragma once

#include <vector>

#include "slots.hpp"

namespace scree::dem {

/// Where in the outer step a force belongs.
enum class Stage { first, middle, last };

/// What kicks and drifts did, summed in a fixed order.
struct Motions {
  double contact_work = 0.0;   ///< on dynamic bodies [J]
  double boundary_work = 0.0;  ///< by bodies that move as told, through contacts [J]
  double force_work = 0.0;     ///< [J]
  double fastest = 0.0;        ///< greatest speed of a point of a body in the drift [m/s]
};

/// Moves the bodies of Slots.
class Verlet {
 public:
  /// Bodies of a chunk of work, the same for every loop over slots.
  static constexpr std::size_t kChunk = 2048;

  /// Takes the forces of slots.wrench and slots.field, completes the velocities of the present time, and, unless this is the
  /// last stage, moves the bodies on by `h` [s] and predicts their velocities.
  Motions advance(Slots& slots, double h, Stage stage, const Executor& executor);

 private:
  void move_chunk(Slots& slots, double h, Stage stage, std::size_t first, std::size_t last, Motions& out) const;
  void turn_chunk(Slots& slots, double h, Stage stage, std::size_t first, std::size_t last, Motions& out) const;

  std::vector<Motions> partial_;
};

}  // namespace scree::dem
