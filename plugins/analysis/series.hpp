// Series: a table of numbers that grows with time, and the looks that fill it.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contact_study/series_table.hpp"
#include "scree/config/parameter.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

class Options;

/// When an observer looks: every `interval`, in whole steps.
class Schedule {
 public:
  /// The setting `interval`.
  static Parameter parameter(double interval,
                             std::string help = "simulated time between two looks; rounded to whole steps");

  Schedule() = default;
  /// `time_step` [s].
  Schedule(const Options& options, double time_step);
  [[nodiscard]] bool is_due(std::uint64_t step) const { return step % every_ == 0; }

 private:
  std::uint64_t every_ = 1;  // steps
};

/// A SeriesTable whose columns are known at setup only, and are asked for by name. The first is the time [s] of the row.
class Series {
 public:
  /// To be called first. `file` empty: nothing is written. @throws Error (io).
  void open(const std::filesystem::path& file, std::vector<SeriesColumn> columns);
  /// As many values as columns. @throws std::logic_error, Error (io).
  void add(std::span<const double> row) { table_->add(row); }
  void add(std::initializer_list<double> row) { add(std::span{row.begin(), row.size()}); }

  [[nodiscard]] std::size_t rows() const { return table_->rows(); }
  /// True until a row of that time [s] is the last.
  [[nodiscard]] bool wants(double time) const { return rows() == 0 || table_->value(rows() - 1, 0) != time; }
  /// @throws std::logic_error when there is no such column.
  [[nodiscard]] std::vector<double> column(std::string_view name) const { return table_->column(index(name)); }
  /// The values of a column in the last rows, those of the last time.
  [[nodiscard]] std::vector<double> last_of(std::string_view name) const;
  /// The same of the first time.
  [[nodiscard]] std::vector<double> first_of(std::string_view name) const;

  /// At the end: the file without these columns; add() is not called any more. @throws std::logic_error when there is no such
  /// column, Error (io).
  void leave_out(std::span<const std::string> columns);

  void save(StateWriter& out, std::string_view name) const { table_->save(*out.group(name)); }
  /// To be called after open(). @throws Error (io).
  void load(const StateReader& in, std::string_view name) { table_->load(*in.group(name)); }

 private:
  [[nodiscard]] std::size_t index(std::string_view name) const;
  std::vector<std::string> names_;
  std::optional<SeriesTable> table_;
};

}  // namespace scree
