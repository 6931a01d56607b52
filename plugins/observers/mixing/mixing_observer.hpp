// MixingObserver: how well two classes of particles are mixed, and how fast they mix.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/classes.hpp"
#include "analysis/region.hpp"
#include "analysis/series.hpp"
#include "analysis/statistics.hpp"
#include "analysis/stem.hpp"
#include "lacey.hpp"
#include "neighbour_index.hpp"
#include "plot/figure.hpp"
#include "scree/interfaces/observer.hpp"

namespace scree {

/// Writes mixing.csv, mixing.svg and mixing.png, or mixing_NAME for an observer with a name.
class MixingObserver final : public Observer {
 public:
  explicit MixingObserver(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  void look(const Observation& now);
  /// The decay of 1 - index over the window of the fit.
  [[nodiscard]] Decay decay_of(const char* index) const;
  [[nodiscard]] plot::Figure figure() const;

  Options options_;
  const Executor* executor_ = nullptr;
  Stem stem_;
  Schedule schedule_;
  TwoClasses classes_;
  CellGrid grid_;
  Lacey lacey_;
  Neighbourhood neighbourhood_;
  bool neighbours_wanted_ = true;
  Series series_;
  std::vector<Lacey::Particle> particles_;  // workspace
  std::vector<Placed> placed_;              // workspace
};

}  // namespace scree
