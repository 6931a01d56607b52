// TimeStepper: advances all bodies by one outer step, with the services of the
// host.
#pragma once

#include <cstdint>
#include <span>

#include "scree/collision/collider.hpp"
#include "scree/collision/contact.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/interfaces/plugin.hpp"
#include "scree/model/body.hpp"

namespace scree {

class ContactLaw;
class Machine;
class Materials;
class SceneServices;

/// What a stepper may ask the host for during a step. It never meets another
/// plugin.
class StepServices {
 public:
  virtual ~StepServices();

  /// Sum of all force fields at the state `bodies` [N], [N m]; `out` is
  /// overwritten.
  virtual void forces(const BodyView& bodies, double time, WrenchView out) = 0;
  /// Contacts at the state `bodies` that are closed or may close within `dt`
  /// [s], sorted by (a, b, primitives, feature). `free_velocity` are the
  /// velocities [m/s] with which gaps are expected to close. Valid until the
  /// next call.
  virtual std::span<const Contact> contacts(const BodyView& bodies, std::span<const Vec3> free_velocity,
                                            std::span<const Vec3> free_angular_velocity, double dt) = 0;
  /// The pairs that can touch as long as all bodies move as `expected` says, and some that cannot. Valid until the next call.
  virtual NeighbourView neighbours(const BodyView& bodies, const ExpectedMotion& expected);
  /// Another number than before when bodies may meet that might not, or the other way round: neighbours are then to be asked for
  /// again. Changes between steps only.
  [[nodiscard]] virtual std::uint64_t filter_version() const { return 0; }
  /// Contacts with a gap below `reach` [m] at the state `bodies`, of those pairs of neighbours() that are not in
  /// its `balls`; sorted as contacts() are. Bodies are those of that call, moved. Valid until the next call.
  virtual std::span<const Contact> neighbour_contacts(const BodyView& bodies, double reach);
  /// True when forces() depends on neither place, motion nor time, and may be asked for once an outer step.
  [[nodiscard]] virtual bool forces_are_steady() const { return false; }
  /// The scene's law of soft contacts; null when there is none.
  [[nodiscard]] virtual const ContactLaw* contact_law() const { return nullptr; }
  /// Solves a CCP with the scene's solver and judges the answer; `gamma` [N s]: warm start in, impulses out.
  virtual SolveSummary solve_ccp(const CcpProblem& problem, std::span<double> gamma) = 0;
  [[nodiscard]] virtual const Materials& materials() const = 0;
  [[nodiscard]] virtual const Executor& executor() const = 0;
  /// The joints and motors of the scene; null when there are none. See Machine for its part in a step.
  [[nodiscard]] virtual Machine* machine() { return nullptr; }
  /// Tells that the step is about to change bodies; see TimeStepper::announces_motion().
  virtual void before_motion() {}
  /// The contacts of the dynamic bodies `few`, in increasing order, with those that forces do not move, at these velocities
  /// [m/s], [rad/s] of all bodies: for those that were not known when contacts() was called in the same step, whose answer stays
  /// valid. Sorted as those; valid until the next call of this.
  virtual std::span<const Contact> wall_contacts(const BodyView& bodies, std::span<const BodyIndex> few,
                                                 std::span<const Vec3> velocity, std::span<const Vec3> angular_velocity,
                                                 double dt);
};

/// What a step did to the dynamic bodies: their kinetic energy changes by
///     force_work + boundary_work + joint_work - contact_loss.
/// Each is an impulse times the mean of the velocities at the beginning and at the end of the step.
struct StepWork {
  double contact_loss = 0.0;  ///< - sum over contacts of gamma . (u0 + u1) / 2 [J], rolling and spinning included; what
                              ///< compliant contacts store counts as lost, and comes back
  double boundary_work = 0.0;  ///< by what moves as told, through contacts: walls, drums, surfaces of conveyors [J]
  double force_work = 0.0;     ///< by all force fields [J]
  double joint_work = 0.0;     ///< by joints with their springs, and motors [J]

  StepWork& operator+=(const StepWork& o) {
    contact_loss += o.contact_loss;
    boundary_work += o.boundary_work;
    force_work += o.force_work;
    joint_work += o.joint_work;
    return *this;
  }
};

/// What a step did. Numerical outcomes are data, not exceptions.
struct StepSummary {
  SolveSummary solve;
  std::size_t contacts = 0;       ///< given to the solver
  double mean_penetration = 0.0;  ///< mean overlap over closed contacts,
                                  ///< relative to the smaller body's radius [1]
  double max_penetration = 0.0;   ///< [m]
  int friction_solves = 1;        ///< CCPs solved for exact Coulomb friction
  double friction_error = 0.0;    ///< what exact Coulomb friction still lacks [m/s]
  StepWork work;
};

/// A time-stepping scheme.
class TimeStepper : public Plugin {
 public:
  static constexpr const char* kKind = "time_stepper";
  ~TimeStepper() override;

  virtual void setup(SceneServices& services);
  /// True when a step solves contact problems: the scene then needs a [ccp_solver] and, for bodies that may touch, a
  /// [[narrow_phase]].
  [[nodiscard]] virtual bool needs_ccp_solver() const { return false; }
  /// True when contacts are soft: the scene then needs a [contact_law] and, for bodies that may touch, a [[narrow_phase]].
  /// What the law says of rolling and cohesion holds in place of resists_rolling().
  [[nodiscard]] virtual bool needs_contact_law() const { return false; }
  /// True when contacts resist rolling and spinning (ContactMaterial::rolling_friction, spinning_friction). A scene that
  /// sets them for a stepper that does not is refused.
  [[nodiscard]] virtual bool resists_rolling() const { return false; }
  /// True when joints and motors (StepServices::machine()) take part in a step. A scene that has them is refused for a
  /// stepper in which they do not.
  [[nodiscard]] virtual bool holds_joints() const { return false; }
  /// True when step() calls StepServices::before_motion() once, before it first changes a body. The host then copies what
  /// undoes a failed step only there, when the contact problem and its solver have given their memory back.
  [[nodiscard]] virtual bool announces_motion() const { return false; }

  /// Advances the dynamic and kinematic bodies from `time` to `time + dt` [s].
  /// dt is the outer step; a scheme may divide it.
  virtual StepSummary step(StepServices& services, const BodyState& bodies, double time, double dt) = 0;
  /// The contacts of the last step, for fields, observers and writers.
  [[nodiscard]] virtual ContactView contacts() const = 0;
};

}  // namespace scree
