// SeriesTable: rows of numbers over time, as a CSV file, for plots, and through checkpoints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scree/results/csv.hpp"

namespace scree {

class StateReader;
class StateWriter;

/// Outer steps between two looks: `interval` [s] rounded to whole steps of `time_step` [s], at least one.
[[nodiscard]] std::uint64_t steps_between(double interval, double time_step);

/// A column of a SeriesTable.
struct SeriesColumn {
  std::string name;
  std::string unit = {};                ///< empty for none
  std::vector<std::string> words = {};  ///< values are indices of these, when there are any
};

/// Keeps its rows, so that a resumed run writes all of them and plots the whole.
class SeriesTable {
 public:
  SeriesTable() = default;
  explicit SeriesTable(std::vector<SeriesColumn> columns) : columns_{std::move(columns)} {}

  /// Creates the file and writes its header. Without, rows are only kept. @throws Error (io).
  void open(const std::filesystem::path& file);
  /// As many values as columns. @throws Error (io).
  void add(std::span<const double> row);
  void close();
  /// Writes the file anew, without the columns for which `left_out` has a 1, and closes it; rows stay. @throws Error (io).
  void close_without(const std::vector<char>& left_out);

  [[nodiscard]] std::size_t rows() const { return columns_.empty() ? 0 : values_.size() / columns_.size(); }
  [[nodiscard]] double value(std::size_t row, std::size_t column) const {
    return values_[row * columns_.size() + column];
  }
  /// The values of `column` in the rows where column `key` has the value `equal`; in all rows without a key.
  [[nodiscard]] std::vector<double> column(std::size_t column) const;
  [[nodiscard]] std::vector<double> column(std::size_t column, std::size_t key, double equal) const;

  void save(StateWriter& out) const;
  /// After open(): rows of the earlier part of the run are written first. @throws Error (io).
  void load(const StateReader& in);

 private:
  void write(std::span<const double> row);
  void write_all();

  std::vector<SeriesColumn> columns_;
  std::vector<char> left_out_;  // of the file, by column; empty for none
  std::vector<double> values_;  // row by row
  std::filesystem::path path_;
  std::unique_ptr<CsvWriter> file_;
};

}  // namespace scree
