// MassFlowObserver: what passes through a gate, and at what rate.
#pragma once

#include <filesystem>
#include <limits>
#include <vector>

#include "analysis/body_memory.hpp"
#include "analysis/frame.hpp"
#include "analysis/grain_materials.hpp"
#include "analysis/series.hpp"
#include "analysis/stem.hpp"
#include "flow_rate.hpp"
#include "gate.hpp"
#include "plot/figure.hpp"
#include "scree/interfaces/observer.hpp"

namespace scree {

/// Writes mass_flow.csv, mass_flow_crossings.csv when asked to, and the figures mass_flow and mass_flow_total; with the
/// observer's name behind the type when it has one.
class MassFlowObserver final : public Observer {
 public:
  explicit MassFlowObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  [[nodiscard]] int version() const override { return 2; }
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  /// Where a body was at the last step, in the frame of the gate [m].
  struct Before {
    static constexpr std::size_t kNumbers = 3;
    Vec3 place;
    [[nodiscard]] std::array<double, 3> numbers() const { return {place.x, place.y, place.z}; }
    static Before of(std::span<const double> n) { return {{n[0], n[1], n[2]}}; }
  };
  /// What has passed since the begin of the run, by material.
  struct Passed {
    double number_forward = 0.0, number_backward = 0.0;
    double mass_forward = 0.0, mass_backward = 0.0;  // [kg]
    [[nodiscard]] double net_mass() const { return mass_forward - mass_backward; }
    Passed& operator+=(const Passed& other);
  };

  void count(const Observation& now, BodyIndex body, const Passage& passage);
  void end_interval(double time);
  [[nodiscard]] Passed passed_by_all() const;
  [[nodiscard]] FlowRate rate_of(const std::string& column) const;
  [[nodiscard]] std::string why_no_rate() const;
  [[nodiscard]] plot::Figure rates() const;
  [[nodiscard]] plot::Figure totals() const;

  Options options_;
  Gate gate_;
  Frame frame_;
  Schedule schedule_;
  Stem stem_;
  GrainMaterials materials_;
  bool lists_crossings_ = false;
  BodyMemory<Before> bodies_;
  std::vector<Passed> passed_;      // by material
  std::vector<double> net_before_;  // net mass of each material at the end of the last interval [kg]
  double interval_begin_ = std::numeric_limits<double>::quiet_NaN();  // [s]; NaN before the first look
  Series series_;
  Series crossings_;
};

}  // namespace scree
