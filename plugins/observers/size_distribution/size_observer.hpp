// SizeObserver: the sizes of the particles in a region, over time.
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/region.hpp"
#include "analysis/series.hpp"
#include "analysis/stem.hpp"
#include "plot/figure.hpp"
#include "scree/interfaces/observer.hpp"
#include "sizes.hpp"

namespace scree {

/// Writes size_distribution.csv, size_distribution_histogram.csv, and the figures size_distribution (cumulative curves) and
/// size_distribution_over_time; with the observer's name behind the type when it has one.
class SizeObserver final : public Observer {
 public:
  explicit SizeObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  void look(const Observation& now);
  void add_histogram(double time);
  [[nodiscard]] plot::Figure curves() const;
  [[nodiscard]] plot::Figure over_time() const;

  Options options_;
  Region region_;
  Schedule schedule_;
  Stem stem_;
  std::vector<char> counts_;   // by material
  std::vector<double> edges_;  // of the classes [m]
  Sizes sizes_;
  Series numbers_;
  Series classes_;
  std::vector<Sized> particles_;  // workspace
  SizeHistogram histogram_;       // workspace
};

}  // namespace scree
