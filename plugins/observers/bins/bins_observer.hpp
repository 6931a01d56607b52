// BinsObserver: counts what falls through a rectangle into bins, and accounts for everything that was fed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bins_result.hpp"
#include "scree/config/options.hpp"
#include "series_log.hpp"

namespace scree {

class Materials;

/// A named set of bodies whose grade and recovery are wanted.
struct Target {
  std::string name;
  std::vector<std::string> materials;  ///< empty: every material
  std::string attribute;               ///< empty: no condition
  double at_least = 0.0;               ///< smallest value of the attribute [its unit]
  AttributeId column = 0;
  CategoryMask material_mask = 0;  ///< bit m: material m belongs to it
};

/// Writes bins_NAME.csv, bins_NAME_series.csv, bins_NAME.svg and .png, and the attribute column bin_NAME.
class BinsObserver final : public Observer {
 public:
  explicit BinsObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  void setup_categories(SceneServices& services);
  void setup_plan();
  void look(const Observation& now);
  [[nodiscard]] CategoryMask categorise(const BodyView& bodies, BodyIndex body) const;
  [[nodiscard]] CategoryMask categorise_removed(std::uint32_t material) const;
  [[nodiscard]] BinsResult result() const;

  Options options_;
  Collector collector_;
  std::vector<Target> targets_;
  double series_interval_;  // [s]

  std::string name_;
  std::filesystem::path results_;
  Categories categories_;
  ProductPlan plan_;
  AttributeId column_ = 0;
  std::uint64_t steps_between_ = 1;
  std::unique_ptr<Tracker> tracker_;  // from here on made by setup()
  std::unique_ptr<SeriesLog> series_;
  TallyTable bins_;
  TallyTable products_;
  std::vector<Binned> binned_;
  double time_ = 0.0;  // of the last look [s]
};

}  // namespace scree
