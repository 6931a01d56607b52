// Series of numbers over time, from text files: what tables and paths are read from.
//
// One time a line, then its numbers, apart by commas, semicolons, blanks or tabs; `#` and `%` begin comments, and a first
// line without a number is a heading.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scree/base/error.hpp"

namespace scree {

/// Rows of equal length in order of time.
struct TimeSeries {
  std::vector<double> times;   ///< [s], ascending
  std::vector<double> values;  ///< row by row, `columns` each [any unit]
  std::vector<int> lines;      ///< of the file, one per row
  std::size_t columns = 0;     ///< beside the time

  [[nodiscard]] std::span<const double> row(std::size_t k) const {
    return std::span{values}.subspan(k * columns, columns);
  }
};

/// Reads a file whose rows have one of `columns` numbers beside the time, all the same; `names` says which, in messages:
/// "time, value". @throws Error (io) when the file cannot be read, (usage) at its line for a word that is no number, a number
/// that is not finite, a row of another length, a time that does not ascend; and at `where` when it has fewer than two rows.
[[nodiscard]] TimeSeries read_time_series(const std::filesystem::path& file, std::span<const std::size_t> columns,
                                          const std::string& names, const SourceLocation& where);

}  // namespace scree
