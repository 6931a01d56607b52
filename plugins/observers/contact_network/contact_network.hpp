// ContactNetwork: coordination, forces and fabric of the contacts between grains.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "contact_study/series_table.hpp"
#include "network.hpp"
#include "scree/config/options.hpp"
#include "scree/interfaces/observer.hpp"
#include "vtp/file_series.hpp"

namespace scree {

/// Normal forces over their mean, as a histogram of equal bins.
class ForceHistogram {
 public:
  static constexpr std::size_t kBins = 40;
  static constexpr double kTop = 8.0;  ///< largest f/<f> of the bins [1]; what is above counts in the last

  void add(const Network& network);
  [[nodiscard]] std::uint64_t count(std::size_t bin) const { return counts_[bin]; }
  [[nodiscard]] std::uint64_t total() const;
  /// Probability density of f/<f> in a bin [1].
  [[nodiscard]] double density(std::size_t bin) const;
  [[nodiscard]] static double edge(std::size_t bin) { return kTop * static_cast<double>(bin) / kBins; }

  void save(StateWriter& out) const;
  void load(const StateReader& in);

 private:
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kBins, 0);
};

/// Writes contact_network.csv, _coordination.csv, _forces.csv, figures of coordination and of forces, and the network as
/// contact_network_*.vtp with contact_network.pvd; with a name, contact_network_NAME.
class ContactNetwork final : public Observer {
 public:
  explicit ContactNetwork(const Options& options);
  static std::vector<Parameter> parameters();

  void setup(SceneServices& services, const std::filesystem::path& results) override;
  void observe(const Observation& now, Attributes& attributes) override;
  void finish(const Observation& last) override;
  [[nodiscard]] std::vector<ReportTable> report() const override;
  void save(StateWriter& out) const override;
  void load(const StateReader& in) override;

 private:
  void add_row(double time);  // of network_
  void write_file(const Observation& now);
  void write_histograms() const;
  void write_figures() const;

  Options options_;
  Region region_;
  std::uint32_t least_;  // links of a grain that is held
  double from_;          // distributions begin [s]

  std::filesystem::path results_;
  std::string stem_;
  const Materials* materials_ = nullptr;
  std::uint64_t row_every_ = 1, file_every_ = 0;  // steps; 0: never
  Network network_;
  double network_time_ = -1.0, end_time_ = 0.0;  // of network_; of the run [s]
  SeriesTable table_;
  FileSeries series_;
  ForceHistogram forces_;
  std::vector<std::uint64_t> degrees_;  // grains with k links, summed over looks
};

}  // namespace scree
