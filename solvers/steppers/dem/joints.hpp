// Joints: holds the joints and motors of a scene in every sub-step.
//
// A drift takes the velocity of the middle of the sub-step; the machine takes out of it what would leave the joints (SHAKE, see
// Machine::settle()), and the bodies of joints are moved again with what is left. At the end of an outer step it takes out of the
// velocities what the joints do not allow (RATTLE, Andersen 1983, J. Comput. Phys. 52:24). Joints act in the kicks of all other
// forces, for half a sub-step at the ends. Rows that are inequalities (stops, motors with limits) are found first, with the equations
// held: contacts are forces here, and known.
#pragma once

#include <vector>

#include "scree/machine/machine.hpp"
#include "slots.hpp"
#include "verlet.hpp"

namespace scree::dem {

class Joints {
 public:
  /// For an outer step; `machine` may be null.
  void begin_step(Machine* machine, const BodyView& bodies);
  [[nodiscard]] bool empty() const { return machine_ == nullptr; }
  /// The bodies of joints, whose orientation is needed even where they are balls.
  [[nodiscard]] std::span<const BodyIndex> bodies() const;

  /// Before a kick, and the drift after it: notes where the bodies are, and writes their poses and velocities to `state`.
  void before(const Slots& slots, const BodyState& state, Stage stage);
  /// After the kick at `time` and, but at the last stage, the drift over `h` [s]: gives the bodies the velocities that joints allow,
  /// and puts them where these lead. Adds to `done` what forces then did less, or more.
  void after(Slots& slots, const BodyView& bodies, double time, double h, Stage stage, Motions& done);
  /// Of all sub-steps of this outer step [J].
  [[nodiscard]] double work() const { return work_; }

 private:
  /// A body of joints during a sub-step.
  struct Body {
    Pose start;
    Twist before;  ///< velocity before the kick [m/s], [rad/s]
    Mat3 inertia;  ///< [kg m2], world, at the start; zero where torques do not turn it
    BodyInertia inverse;
    std::size_t turning = 0;  ///< entry of Slots::turning, or kNone
  };
  static constexpr std::size_t kNone = ~std::size_t{0};

  struct Response;

  void find_free(const Slots& slots, double h);
  void allow(Slots& slots, double h, double kick, Motions& done);
  void solve_rows(std::span<Twist> velocity);
  void answer(std::span<const double> defect, std::span<Twist> velocity, std::span<double> impulse);
  void add(const MachineRow& row, double impulse, std::span<Twist> velocity) const;
  [[nodiscard]] static double rate(const MachineRow& row, std::span<const Twist> velocity);
  void sweep(const MachineProblem& problem, std::span<const MachineRow> rows, std::span<const Response> responses);

  Machine* machine_ = nullptr;
  double work_ = 0.0;
  std::vector<Body> held_;  // in the machine's order
  std::vector<Twist> free_,
      velocity_;                 // without joints, and with them; velocity_ those of the last kick before the next one
  std::vector<double> impulse_;  // [N s]
  JointProjection equations_;
  std::vector<MachineRow> equation_rows_;
};

}  // namespace scree::dem
