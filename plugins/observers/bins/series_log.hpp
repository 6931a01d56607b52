// SeriesLog: what came into the bins, by interval of simulated time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amounts.hpp"
#include "scree/results/csv.hpp"

namespace scree {

/// Collects amounts and writes those that are not zero at the end of every interval. The sum over a file's rows is the
/// content of the bins.
class SeriesLog {
 public:
  SeriesLog(std::size_t categories, std::size_t bins) : window_{categories, bins} {}

  /// `file` empty: nothing is written. Rows of an earlier part of the run are written first. @throws Error (io).
  void open(const std::filesystem::path& file, const std::vector<std::string>& category_names);
  void add(CategoryMask mask, std::size_t bin, double mass) { window_.add(mask, bin, mass); }
  /// Ends the interval at `time` [s]. @throws Error (io).
  void end_interval(double time);

  void save(StateWriter& out) const;
  /// To be called after open(). @throws Error (io).
  void load(const StateReader& in);

 private:
  struct Row {
    double time;  // end of the interval [s]
    std::uint64_t category, bin;
    Tally amount;
  };
  void write(const Row& row);

  TallyTable window_;
  std::vector<Row> rows_;
  std::vector<std::string> names_;
  std::optional<CsvWriter> table_;
};

}  // namespace scree
