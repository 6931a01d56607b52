// BodyLoad: force, torque and power that contacts give to named bodies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "contact_study/followed_bodies.hpp"
#include "contact_study/series_table.hpp"
#include "load_account.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/observer.hpp"

namespace scree {

/// Writes body_load.csv and figures of force, torque and power; with a name, body_load_NAME.
class BodyLoad final : public Observer {
 public:
  explicit BodyLoad(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

  /// Of the whole run so far, in the order of the scene's list.
  [[nodiscard]] const LoadSum& total(std::size_t slot) const { return followed_state_[slot].total; }

 private:
  /// What is kept of a followed body from step to step.
  struct Followed {
    LoadSum interval, total;
    Twist velocity;                              // at the end of the last step [m/s], [rad/s]
    bool seen = false;                           // in the last step
    Vec3 axis;                                   // it turned about last [1]
    double peak_force = 0.0, peak_torque = 0.0;  // means of an interval [N], [N m]
    double left = -1.0;                          // time when it was missed first [s]; negative: there
  };

  void find_motions(const Observation& now);
  [[nodiscard]] Twist velocity_before(const Observation& now, BodyIndex body) const;
  void add_summed(const Observation& now);
  void end_interval(double time);
  void write_figures() const;

  Options options_;
  double interval_;  // [s]
  std::filesystem::path results_;
  std::string stem_;
  std::uint64_t every_ = 1;  // steps in an interval
  FollowedBodies followed_;
  std::vector<Followed> followed_state_;  // by slot
  std::vector<BodyMotion> motions_;       // of the step, by slot
  std::vector<char> summed_;              // of the step, by slot: the stepper says what contacts did
  SeriesTable table_;
};

}  // namespace scree
