// CollisionEnergy: spectra of the energies of collisions, by pair of materials.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "contact_study/series_table.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/observer.hpp"
#include "spectra.hpp"

namespace scree {

/// Writes collision_energy.csv (spectra), collision_energy_series.csv and a figure; with a name, collision_energy_NAME.
class CollisionEnergy final : public Observer {
 public:
  explicit CollisionEnergy(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

  [[nodiscard]] const Spectra& spectra() const { return spectra_; }

 private:
  /// Sums of an interval.
  struct Sums {
    double collisions = 0.0, normal = 0.0, tangential = 0.0, dissipated = 0.0;  // [1], [J]
  };
  void count(const Collision& collision);
  void end_interval(double time);
  void write_spectra() const;
  void write_figure() const;

  Options options_;
  double min_speed_;  // [m/s]
  double from_;       // [s]
  std::filesystem::path results_;
  std::string stem_;
  std::uint64_t every_ = 1;  // steps in an interval
  ImpactBook book_;
  Spectra spectra_;
  Sums sums_;
  SeriesTable series_;
  double began_ = 0.0;     // the interval [s]
  double row_due_ = 0.0;   // end of an interval whose row is not written yet, since the run may end with it [s]
  double observed_ = 0.0;  // time that the spectra are of [s]
  double slow_ = 0.0;      // collisions that were left out as too slow [1]
  std::vector<Collision> ended_;
};

}  // namespace scree
