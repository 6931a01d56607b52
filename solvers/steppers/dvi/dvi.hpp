// DVI time stepping: semi-implicit, velocity and impulse, one cone
// complementarity problem a step (Critelli et al., eqs 1-9; Tasora & Anitescu
// 2010, 2011).
//
//     v1 = v0 + h M^-1 f(q0, v0) + M^-1 D gamma,   q1 = Lambda(q0, v1, h)
//
// with gamma from ContactAssembly's problem. Lambda is the exponential map on
// orientations.
#pragma once

#include <vector>

#include "contact_assembly.hpp"
#include "scree/ccp/contact_memory.hpp"
#include "scree/ccp/coulomb.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "step_work.hpp"

namespace scree {

/// What a scene can say about dvi.
struct DviOptions {
  dvi::ContactLimits limits = {};
  bool coulomb = false;  ///< exact Coulomb friction in place of the associated problem
  CoulombLimits coulomb_limits = {};
  bool gyroscopic = false;  ///< gyroscopic torque of bodies with three moments
  bool warm_start = true;   ///< start from the impulses of the last step
};

/// The stepper. No allocation in a step once its workspace has its size, unless there are many contacts.
class Dvi final : public TimeStepper {
 public:
  explicit Dvi(const DviOptions& options) : options_{options} {}
  explicit Dvi(const Options& options);
  static std::vector<Parameter> parameters();

  [[nodiscard]] bool needs_ccp_solver() const override { return true; }
  [[nodiscard]] bool resists_rolling() const override { return true; }
  [[nodiscard]] bool holds_joints() const override { return true; }
  [[nodiscard]] bool announces_motion() const override { return true; }
  StepSummary step(StepServices& services, const BodyState& bodies, double time, double dt) override;
  [[nodiscard]] ContactView contacts() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  /// Where a body is after a step, and how it turns then.
  struct FreeStep {
    Pose pose;
    Vec3 angular_velocity;  ///< [rad/s], world
  };

  void free_motion(StepServices& services, const BodyView& bodies, double time, double dt);
  std::span<const Contact> find_contacts(StepServices& services, const BodyView& bodies, double dt);
  /// After solve(): whether bodies that were struck would cross a wall; seen_ then holds its contacts beside those `found`.
  bool look_again(StepServices& services, const BodyView& bodies, std::span<const Contact> found, double dt);
  [[nodiscard]] dvi::JoinedBodies pose_joints(Machine* machine, const BodyView& bodies, double time, double dt);
  void settle_joints(Machine& machine);
  void solve(StepServices& services, const BodyView& bodies, StepSummary& summary, double dt);
  void finish(StepServices& services, const BodyView& bodies, StepSummary& summary, double dt);
  void recall(const BodyView& bodies, const CcpProblem& problem, const Executor& executor, double dt);
  void find_keys(const BodyView& bodies, const Executor& executor);
  void keep_results(const BodyView& bodies, const Executor& executor);
  void remember(const BodyView& bodies, const Executor& executor, double dt);
  void release_step();
  void measure_overlap(const BodyView& bodies, StepSummary& summary) const;
  [[nodiscard]] FreeStep free_step(const BodyView& bodies, BodyIndex i, const Twist& velocity, double dt) const;
  void move(const BodyState& bodies, const Executor& executor, double dt) const;

  DviOptions options_;
  dvi::ContactAssembly assembly_;
  CoulombIteration coulomb_;
  DelassusOperator delassus_;

  std::vector<Vec3> force_, torque_;
  std::vector<Vec3> velocity_, angular_velocity_;      ///< of all bodies: free, then with impulses
  std::vector<Vec3> surface_velocity_, surface_spin_;  ///< free, with surface motions; empty when no body has one
  std::vector<Vec3> struck_velocity_, struck_spin_;    ///< with the impulses; of a second look
  std::vector<BodyIndex> struck_;                      ///< that impulses move farther than was looked for
  std::vector<Contact> seen_;  ///< contacts of the first look and those that the second one adds
  std::vector<double> gamma_;
  std::vector<Twist> w_;
  std::vector<Twist> joined_;            ///< velocities of the bodies of joints, in the machine's order
  PoseAfter motion_;                     ///< pose_after() for the machine, of this step
  std::span<const double> joint_guess_;  ///< the machine's, of this step [N s]

  std::vector<Vec3> impulse_, before_, after_;  ///< per contact, as found
  std::vector<Vec3> angular_impulse_;           ///< the same; empty when nothing resists rolling
  std::vector<ContactKey> keys_;                ///< per contact, as found
  std::vector<Vec3> world_impulse_, world_angular_impulse_;
  std::vector<StepWork> work_;  ///< per chunk, workspace
  ContactMemory memory_;
  double step_dt_ = 0.0;    ///< of the last step [s]
  double memory_dt_ = 0.0;  ///< step that the remembered impulses belong to [s]
};

}  // namespace scree
