#include "scree/results/csv.hpp"

#include <fmt/format.h>

#include "scree/base/require.hpp"

namespace scree {

namespace {

std::string quoted(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string{text};
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& file, const std::vector<CsvColumn>& columns)
    : file_{file}, columns_{columns.size()} {
  for (const CsvColumn& column : columns) {
    cell(std::string_view{column.unit.empty() ? column.name : column.name + " [" + column.unit + "]"});
  }
  end_row();
}

void CsvWriter::separate() {
  if (cells_++ > 0) row_ += ',';
}

CsvWriter& CsvWriter::cell(double value) {
  separate();
  row_ += fmt::format("{}", value);  // the shortest digits that read back to the same bits
  return *this;
}

CsvWriter& CsvWriter::cell(std::uint64_t value) {
  separate();
  row_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::cell(std::int64_t value) {
  separate();
  row_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::cell(std::string_view text) {
  separate();
  row_ += quoted(text);
  return *this;
}

void CsvWriter::end_row() {
  SCREE_REQUIRE(cells_ == columns_, "a row has as many cells as the table has columns");
  row_ += '\n';
  file_.write(row_);
  file_.flush();
  row_.clear();
  cells_ = 0;
}

}  // namespace scree
