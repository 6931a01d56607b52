// ContinuumObserver: continuum fields of the flow on a grid, averaged over windows of time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/series.hpp"
#include "analysis/stem.hpp"
#include "coarse_field.hpp"
#include "plot/heat_map.hpp"
#include "scree/interfaces/observer.hpp"
#include "vtp/file_series.hpp"

namespace scree {

/// Writes continuum_STEP.vti and continuum.pvd, continuum_profile.csv, and the figure continuum_slice; with the observer's name
/// behind the type when it has one.
class ContinuumObserver final : public Observer {
 public:
  explicit ContinuumObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  void look(const Observation& now);
  void end_window(const Observation& now);
  [[nodiscard]] std::vector<CoarseCell> cells() const;
  void write_fields(const std::vector<CoarseCell>& cells, const Observation& now);
  void add_profile(const std::vector<CoarseCell>& cells, double time);
  [[nodiscard]] plot::HeatMap slice(const std::vector<CoarseCell>& cells, double time) const;

  Options options_;
  const Executor* executor_ = nullptr;
  std::filesystem::path results_;
  Schedule schedule_;
  Stem stem_;
  CellGrid grid_;
  bool contact_stress_ = false;
  std::uint64_t steps_of_window_ = 0;  // 0: one window until the end
  std::unique_ptr<CoarseField> field_;
  double window_begin_ = 0.0;  // [s]
  Series profiles_;
  FileSeries files_;
  std::vector<Grain> grains_;          // workspace
  std::vector<BranchPoint> branches_;  // workspace
};

}  // namespace scree
