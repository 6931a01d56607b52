// SegregationObserver: how particles part along an axis, by size, density, material or another class.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/classes.hpp"
#include "analysis/grain_materials.hpp"
#include "analysis/region.hpp"
#include "analysis/series.hpp"
#include "analysis/stem.hpp"
#include "plot/figure.hpp"
#include "scree/interfaces/observer.hpp"
#include "separation.hpp"

namespace scree {

/// Writes segregation.csv, segregation_profile.csv, and the figures segregation (over time) and segregation_profile; with the
/// observer's name behind the type when it has one.
class SegregationObserver final : public Observer {
 public:
  explicit SegregationObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  [[nodiscard]] int version() const override { return 2; }
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  void look(const Observation& now);
  void add_profile(double time);
  [[nodiscard]] plot::Figure over_time() const;
  [[nodiscard]] plot::Figure profile() const;

  Options options_;
  Vec3 axis_;  // unit, in the frame of the region
  Region region_;
  Schedule schedule_;
  Stem stem_;
  TwoClasses classes_;
  GrainMaterials materials_;
  std::unique_ptr<AxisProfile> bins_;
  Series series_;
  Series profiles_;
  std::vector<OnAxis> particles_;  // workspace
};

}  // namespace scree
