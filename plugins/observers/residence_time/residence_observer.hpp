// ResidenceObserver: how long bodies stay, in a region or in the simulation.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/series.hpp"
#include "analysis/stem.hpp"
#include "plot/figure.hpp"
#include "residence.hpp"
#include "scree/interfaces/observer.hpp"
#include "stays.hpp"

namespace scree {

/// Writes residence_time.csv (hold-up over time), residence_time_stays.csv (each stay), residence_time_distribution.csv, and
/// the figure residence_time; with the observer's name behind the type when it has one.
class ResidenceObserver final : public Observer {
 public:
  explicit ResidenceObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  /// Residence times of one material, or of all.
  struct Kind {
    std::string name;
    std::vector<Weighted> times;
  };
  void look(const Observation& now);
  void add_row(double time);
  /// All, then the materials of which something has left.
  [[nodiscard]] std::vector<Kind> kinds() const;
  [[nodiscard]] std::vector<double> edges(const std::vector<Kind>& kinds) const;
  void write_distribution(const std::vector<Kind>& kinds) const;
  [[nodiscard]] plot::Figure figure(const std::vector<Kind>& kinds) const;

  Options options_;
  Schedule schedule_;
  Stem stem_;
  std::vector<std::string> materials_;
  std::unique_ptr<Stays> stays_;
  Series hold_up_;
  Series ended_;
  std::vector<Stay> ended_now_;  // workspace
};

}  // namespace scree
