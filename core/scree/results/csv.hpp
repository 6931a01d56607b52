// CsvWriter: tables of results, one header line with units, numbers that read back to the same bits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scree/results/output_file.hpp"

namespace scree {

/// A column of a table: "time [s]"; a column without unit is a count, a name or a text.
struct CsvColumn {
  std::string name;
  std::string unit;  ///< empty for none
};

/// Writes a table row by row. Every row reaches the system before end_row() returns, so that a run that is killed
/// leaves whole rows.
class CsvWriter {
 public:
  /// Creates the file and writes the header. @throws Error (io).
  CsvWriter(const std::filesystem::path& file, const std::vector<CsvColumn>& columns);

  CsvWriter& cell(double value);
  CsvWriter& cell(std::uint64_t value);
  CsvWriter& cell(std::int64_t value);
  /// Quoted when the text holds a comma, a quote or a line break.
  CsvWriter& cell(std::string_view text);
  /// @throws std::logic_error when the row has not as many cells as the header, Error (io).
  void end_row();
  void close() { file_.close(); }

 private:
  void separate();
  OutputFile file_;
  std::size_t columns_;
  std::size_t cells_ = 0;
  std::string row_;
};

}  // namespace scree
