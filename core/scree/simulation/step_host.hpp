// StepHost: the services that a time stepper calls during a step.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "scree/ccp/active_set.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "scree/machine/machine.hpp"
#include "scree/simulation/birth_check.hpp"
#include "scree/simulation/parts.hpp"
#include "scree/simulation/phase_timer.hpp"

namespace scree {

/// Receives a contact problem and the guess that its solver starts from [N s].
using ProblemTap = std::function<void(const CcpProblem&, std::span<const double> guess)>;

/// Answers a stepper from the scene's fields, collision phases and solver, and keeps the time of each.
class StepHost final : public StepServices {
 public:
  StepHost(const Parts& parts, CollisionPipeline& pipeline, Machine& machine, const Materials& materials,
           const Executor& executor, PhaseTimer& timer)
      : parts_{parts},
        pipeline_{pipeline},
        machine_{machine},
        materials_{materials},
        executor_{executor},
        timer_{timer} {}

  /// Has the first contacts of a step looked at by `births`; `known` are the bodies of the scene. All outlive the host.
  void watch_births(BirthCheck& births, std::span<const SceneBody> known, const ShapeSet& shapes) {
    births_ = &births;
    known_ = known;
    shapes_ = &shapes;
  }

  void forces(const BodyView& bodies, double time, WrenchView out) override;
  std::span<const Contact> contacts(const BodyView& bodies, std::span<const Vec3> free_velocity,
                                    std::span<const Vec3> free_angular_velocity, double dt) override;
  NeighbourView neighbours(const BodyView& bodies, const ExpectedMotion& expected) override;
  [[nodiscard]] std::uint64_t filter_version() const override { return pipeline_.filter().version(); }
  std::span<const Contact> neighbour_contacts(const BodyView& bodies, double reach) override;
  [[nodiscard]] bool forces_are_steady() const override;
  [[nodiscard]] const ContactLaw* contact_law() const override {
    return parts_.law ? parts_.law->plugin.get() : nullptr;
  }
  SolveSummary solve_ccp(const CcpProblem& problem, std::span<double> gamma) override;
  [[nodiscard]] const Materials& materials() const override { return materials_; }
  [[nodiscard]] const Executor& executor() const override { return executor_; }
  [[nodiscard]] Machine* machine() override { return machine_.empty() ? nullptr : &machine_; }
  void before_motion() override { on_motion_(); }
  std::span<const Contact> wall_contacts(const BodyView& bodies, std::span<const BodyIndex> few,
                                         std::span<const Vec3> velocity, std::span<const Vec3> angular_velocity,
                                         double dt) override;
  /// What before_motion() calls.
  void on_motion(std::function<void()> action) { on_motion_ = std::move(action); }
  /// Shows the next problem that is posed to `tap`, which may be empty, and no other one.
  void tap_next(ProblemTap tap) { tap_ = std::move(tap); }

 private:
  void check_births(const BodyView& bodies, const NeighbourView& neighbours);

  const Parts& parts_;
  CollisionPipeline& pipeline_;
  Machine& machine_;
  const Materials& materials_;
  const Executor& executor_;
  PhaseTimer& timer_;
  ActiveSetSolve active_set_;
  BirthCheck* births_ = nullptr;
  std::span<const SceneBody> known_;
  const ShapeSet* shapes_ = nullptr;
  ProblemTap tap_;
  std::function<void()> on_motion_ = [] {};
};

}  // namespace scree
