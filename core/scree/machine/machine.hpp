// Machine: the joints, motors and couplings of a scene during a run.
//
// A time stepper that knows joints goes through a step so:
//
//     machine.locate(bodies);                                  // which bodies, where in the view
//     machine.pose(bodies, free velocities, after, step);      // rows at the free motion
//     problem() -> blocks of the contact problem -> impulses
//     machine.settle(impulses, velocities, after);             // what the solver left in the joints is taken out
//
// With h the step, Psi a row's value, v_f the free velocities and q_f the poses after a step with them:
//
//     equation, coupling, position motor   r = Psi(q_f, t1) / h      u = N g + r = 0
//     speed motor                          r = D^T v_f - f mean      u = 0, |g| <= h limit
//     effort motor                         g = h f(t1)
//     spring k, d, rest, preload F         E = 1 / (h (h k + d)),  r = D^T v_f + (k Psi - F) / (h k + d)
//     stop                                 r = Psi(q_f) / h          g >= 0, u >= 0
//
// (Critelli et al., eq. 8: Psi / h + (grad Psi)^T v1 + dPsi/dt = 0; Psi(q_f) / h also holds what the motion's curvature adds
// in a step.) In the springs, Psi stands for Psi(q_f) - h D^T v_f.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "scree/machine/joint_projection.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// The pose of a body after the step, for its velocity in it.
using PoseAfter = std::function<Pose(BodyIndex, const Twist&)>;

/// When a machine acts. A stepper may kick bodies for other times than they drift: at the ends of its steps half as long.
struct MachineStep {
  double time = 0.0;   ///< at its beginning [s]
  double drift = 0.0;  ///< for which bodies move [s]; 0: velocities are to obey the joints where bodies are
  double kick = 0.0;   ///< for which springs, motors and stops act [s]
};

/// What a machine adds to the contact problem of a step. Spans hold until the next pose().
struct MachineProblem {
  std::span<const CcpBlock> blocks;    ///< bodies are those of the view; `first_row` counts from 0
  std::span<const CcpRow> rows;        ///< parts of the world are zero
  std::span<const double> r;           ///< one a row [m/s]
  std::span<const double> compliance;  ///< one a row [1/kg]
  std::span<const double> guess;       ///< impulses of the last step, one a row [N s]
};

/// A joint, motor or coupling over the last step.
struct MachineReport {
  Vec3 force;                     ///< of a joint's equations, springs and stops on b [N], world
  Vec3 torque;                    ///< the same about the origin of its frame on b [N m], world
  double rotation = 0.0;          ///< coordinate [rad]
  double translation = 0.0;       ///< coordinate [m]
  double rotation_rate = 0.0;     ///< [rad/s]
  double translation_rate = 0.0;  ///< [m/s]
  double effort_torque = 0.0;     ///< of a motor, or of a joint's spring of the rotation [N m]
  double effort_force = 0.0;      ///< of a motor, or of a joint's spring of the translation [N]
  double power = 0.0;             ///< given to the bodies, mean over the step [W]
  double energy = 0.0;            ///< given to the bodies so far [J]
  double position_error = 0.0;    ///< greatest violation of an equation [m]; angles times the joint's length
  bool gone = false;              ///< broken, or without its bodies
};

class Machine {
 public:
  /// @throws std::logic_error when a description names what does not exist.
  explicit Machine(MachineDescription description);
  ~Machine();

  [[nodiscard]] bool empty() const { return groups_.empty(); }
  [[nodiscard]] const MachineDescription& description() const { return description_; }

  /// Finds the bodies; joints of bodies that have left are gone. The first call of a step.
  void locate(const BodyView& bodies);
  /// The bodies of all joints, by number in the machine.
  [[nodiscard]] std::span<const BodyIndex> bodies() const { return bodies_; }
  /// Takes the present poses for those at which couplings and turns begin.
  void start(const BodyView& bodies);

  /// Makes the rows of a step. `free` [m/s], [rad/s]: velocities without impulses, one per entry of bodies(), in that order;
  /// the velocities of `bodies` are those before all impulses of the kick. `bodies` and `after` stay valid until settle().
  void pose(const BodyView& bodies, std::span<const Twist> free, const PoseAfter& after, const MachineStep& step);
  [[nodiscard]] MachineProblem problem() const;

  /// Takes out of `velocity` (one per entry of bodies(), at the end of the step) what it lacks in the rows that hold
  /// exactly, and adds that to `impulse`, one per row [N s]. Then notes forces, power and what broke.
  void settle(std::span<double> impulse, std::span<Twist> velocity, const PoseAfter& after);

  /// Of the last step: joints, then motors, then couplings.
  [[nodiscard]] std::span<const MachineReport> reports() const { return reports_; }
  /// Work of all joints, springs and motors on the bodies that forces move, in the last step [J].
  [[nodiscard]] double work() const { return work_; }
  /// Sentences about joints that broke, or whose bodies left, in the last step.
  [[nodiscard]] std::span<const std::string> news() const { return news_; }
  /// True of a joint that broke, or one of whose bodies has left.
  [[nodiscard]] bool is_gone(std::uint32_t joint) const { return states_[joint].gone; }

  /// Keeps what a step changes of the machine; undo() goes back to it, after a step that failed.
  void keep();
  void undo();

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  /// What decides the next step and is not in the scene.
  struct Memory {
    std::vector<JointState> states;
    std::vector<double> impulse, energy;  // [N s], [J]
    double dt = 0.0;                      // [s]
  };
  static constexpr int kGone = -2;  // a body that has left

  /// A row of the current step.
  struct StepRow {
    RowGroup group;
    std::uint8_t k = 0;  ///< of the group
    MachineRow at;
    double scale = 1.0;       ///< L of angles, else 1 [m] or [1]
    double offset = 0.0;      ///< b of rows that are linear in the velocities [m/s]
    double compliance = 0.0;  ///< [1/kg]
    bool linear = false;      ///< else its value after the step shall vanish
    bool exact = false;       ///< settle() makes it hold
  };

  void place(const BodyView& bodies, std::span<const Twist> velocity, const PoseAfter* after,
             std::vector<JointPlacement>& out) const;
  void add_group(const RowGroup& group, std::span<const Twist> free);
  [[nodiscard]] MachineRow row_of(const RowGroup& group, std::size_t k) const;
  [[nodiscard]] double right_side(StepRow& row, CcpBlock& block, std::span<const Twist> free) const;
  [[nodiscard]] double spring_side(StepRow& row, const SpringLaw& law, double preload, double rate_free) const;
  [[nodiscard]] double stop_side(const StepRow& row, double rate_free) const;
  [[nodiscard]] double motor_side(StepRow& row, CcpBlock& block, double rate_free) const;
  [[nodiscard]] double value(const StepRow& row, std::span<const JointPlacement> joints) const;
  [[nodiscard]] double rate(const MachineRow& row, std::span<const Twist> velocity) const;
  [[nodiscard]] double rate_of_moved(const MachineRow& row, std::span<const Twist> velocity) const;
  [[nodiscard]] bool is_gone(const RowGroup& group) const;
  [[nodiscard]] MachineReport& report_of(const RowGroup& group);

  void hold(std::span<double> impulse, std::span<Twist> velocity, const PoseAfter& after);
  [[nodiscard]] bool let_go_of_overloaded(std::span<const double> impulse);
  void gather_held(std::span<const double> impulse);
  [[nodiscard]] double find_defects(std::span<const double> impulse, std::span<const Twist> velocity,
                                    const BodyView& bodies, const PoseAfter& after);
  void apply_correction(std::span<double> impulse, std::span<Twist> velocity);
  void push(const MachineRow& row, double impulse, std::span<Twist> velocity) const;
  void account(std::span<const double> impulse, std::span<const Twist> velocity);
  void note_coordinates(std::span<const Twist> velocity);
  void break_overloaded();

  MachineDescription description_;
  std::vector<RowGroup> groups_;
  std::vector<BodyId> ids_;               ///< of all bodies that joints name
  std::vector<std::array<int, 2>> ends_;  ///< bodies of the joints by number; -1 for the world
  std::vector<BodyIndex> bodies_;         ///< by number
  std::vector<int> numbers_;              ///< by id, or kGone
  std::vector<JointState> states_;
  std::vector<double> last_impulse_;  ///< by slot, of last_kick_ [N s]
  std::vector<double> energy_;        ///< by report [J]
  double last_kick_ = 0.0;            ///< [s]
  Memory kept_;

  MachineStep step_;
  double end_ = 0.0;                    // of the step [s]
  double work_ = 0.0;                   // of the step [J]
  BodyView view_;                       // of the step
  std::vector<BodyInertia> inertia_;    // by number
  std::vector<Twist> before_;           // at the beginning, by number
  std::vector<double> length_;          // L by joint [m]
  std::vector<JointPlacement> placed_;  // at the beginning
  std::vector<JointPlacement> after_;   // at the end of the free motion, then of the true one
  std::vector<StepRow> step_rows_;
  std::vector<CcpBlock> blocks_;
  std::vector<CcpRow> rows_;
  std::vector<double> r_, compliance_, guess_;  // per row

  JointProjection projection_;
  std::vector<std::uint32_t> held_;  // rows that settle() makes hold
  std::vector<MachineRow> held_rows_;
  std::vector<double> held_compliance_, defect_, correction_;
  std::vector<double> solved_impulse_;  // the solver's
  std::vector<Twist> solved_velocity_;
  std::vector<MachineReport> reports_;
  std::vector<std::string> news_;
};

}  // namespace scree
