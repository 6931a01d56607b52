// DEM time stepping: soft contacts, many short steps of velocity Verlet within an outer step (Cundall & Strack 1979,
// Geotechnique 29:47).
//
//     M a = f_fields + sum over contacts of the law's force;   x, v by verlet.hpp
//
// Neighbours are found once for many steps (Verlet 1967): all pairs within a skin, until two bodies may have used it up. What
// contacts keep, such as tangential springs, goes with the ids of their bodies.
#pragma once

#include <vector>

#include "ball_contacts.hpp"
#include "contact_records.hpp"
#include "drift.hpp"
#include "evaluation.hpp"
#include "joints.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "shape_contacts.hpp"
#include "slots.hpp"
#include "verlet.hpp"

namespace scree {

/// What a scene can say about dem.
struct DemOptions {
  double sub_step = 0.0;          ///< [s]; 0: the longest that the law calls stable
  bool force_step = false;        ///< take sub_step although the law calls it too long
  double skin = 0.0;              ///< of the neighbour list [m]; 0: a part of the smallest radius
  bool at_contact_point = false;  ///< forces act midway between the surfaces, in place of at each undeformed surface
};

/// The stepper. No allocation in a sub-step once its workspace has its size, but for joints with stops or limited motors.
class Dem final : public TimeStepper {
 public:
  explicit Dem(const DemOptions& options) : options_{options} {}
  explicit Dem(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services) override;
  [[nodiscard]] bool needs_contact_law() const override { return true; }
  [[nodiscard]] bool holds_joints() const override { return true; }
  StepSummary step(StepServices& services, const BodyState& bodies, double time, double dt) override;
  /// Made when asked for: most steps of most scenes have nobody who looks at them.
  [[nodiscard]] ContactView contacts() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  /// What one outer step goes on with.
  struct Call {
    StepServices& services;
    const BodyState& bodies;
    const ContactLaw& law;
    double time;
    double dt;
  };

  void take_over(const Call& call);
  void choose_sub_step(const Call& call);
  struct Extremes;

  [[nodiscard]] Extremes extremes_of(const BodyView& bodies, BodyIndex body) const;
  [[nodiscard]] std::vector<Extremes> extremes(const Call& call) const;
  /// [s]; `stiffest` gets the materials of the contact that allows no more.
  [[nodiscard]] double stable_step(const Call& call, std::array<std::uint32_t, 2>& stiffest) const;
  void refuse_moving_surfaces_of_balls(const BodyView& bodies) const;
  void follow_bodies(const BodyView& bodies);
  void find_neighbours(const Call& call);
  void ask_fields(const Call& call, double time);
  dem::ContactTally ask_contacts(const Call& call, dem::Stage stage);
  void watch_drift(const Call& call, double way);
  void keep_results(const Call& call, const dem::ContactTally& tally, const dem::Motions& work, StepSummary& summary);

  DemOptions options_;
  Options scene_options_;  ///< for the place of a message
  SceneServices* scene_ = nullptr;
  bool told_ = false;    ///< the log knows the sub-step
  bool warned_ = false;  ///< of overlaps

  dem::Slots slots_;
  dem::Verlet verlet_;
  dem::BallContacts balls_;
  dem::ShapeContacts shapes_;
  dem::Joints joints_;
  dem::Drift drift_;
  mutable dem::ContactRecords records_, ball_records_;  ///< of the last step, once contacts() was called
  mutable bool report_is_due_ = false;
  dem::ContactRecords shape_records_;
  const Executor* executor_ = nullptr;

  std::vector<BodyId> ids_;                       ///< of the bodies that all of the above numbers
  std::vector<BodyIndex> listed_;                 ///< bodies whose poses the host needs for the contacts of shapes
  std::vector<Vec3> field_force_, field_torque_;  ///< by body
  std::uint64_t steps_since_sort_ = 0;
  bool list_is_good_ = false;
  std::uint64_t filter_version_ = 0;  ///< that the list was made with
  double skin_ = 0.0;                 ///< [m]
  double reach_ = 0.0;                ///< of the law, for the largest bodies [m]
  double unstored_ = 0.0;             ///< time since bodies were last written back [s]
  double h_ = 0.0;                    ///< sub-step [s]
  double last_h_ = 0.0;               ///< of the last outer step [s]
  std::size_t sub_steps_ = 0;
};

}  // namespace scree
