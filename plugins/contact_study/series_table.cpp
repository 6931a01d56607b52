#include "contact_study/series_table.hpp"

#include <algorithm>
#include <cmath>

#include "scree/base/require.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

std::uint64_t steps_between(double interval, double time_step) {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(interval / time_step)));
}

void SeriesTable::open(const std::filesystem::path& file) {
  path_ = file;
  std::vector<CsvColumn> header;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (left_out_.empty() || left_out_[i] == 0) header.push_back({columns_[i].name, columns_[i].unit});
  }
  file_ = std::make_unique<CsvWriter>(file, header);
}

void SeriesTable::add(std::span<const double> row) {
  SCREE_REQUIRE(row.size() == columns_.size(), "a row has one value per column");
  values_.insert(values_.end(), row.begin(), row.end());
  write(row);
}

void SeriesTable::write(std::span<const double> row) {
  if (!file_) return;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (!left_out_.empty() && left_out_[i] != 0) continue;
    const std::vector<std::string>& words = columns_[i].words;
    if (words.empty()) {
      file_->cell(row[i]);
    } else {
      file_->cell(std::string_view{words[static_cast<std::size_t>(row[i])]});
    }
  }
  file_->end_row();
}

void SeriesTable::close() {
  if (file_) file_->close();
}

void SeriesTable::close_without(const std::vector<char>& left_out) {
  SCREE_REQUIRE(left_out.size() == columns_.size(), "a mark for each column");
  if (!file_) return;
  file_->close();
  left_out_ = left_out;
  open(path_);
  write_all();
  file_->close();
}

std::vector<double> SeriesTable::column(std::size_t column) const {
  std::vector<double> found(rows());
  for (std::size_t row = 0; row < found.size(); ++row) found[row] = value(row, column);
  return found;
}

std::vector<double> SeriesTable::column(std::size_t column, std::size_t key, double equal) const {
  std::vector<double> found;
  for (std::size_t row = 0; row < rows(); ++row) {
    if (value(row, key) == equal) found.push_back(value(row, column));
  }
  return found;
}

void SeriesTable::save(StateWriter& out) const { out.write("rows", std::span<const double>{values_}); }

void SeriesTable::load(const StateReader& in) {
  values_ = in.doubles("rows");
  write_all();
}

void SeriesTable::write_all() {
  for (std::size_t row = 0; row < rows(); ++row) {
    write(std::span<const double>{values_}.subspan(row * columns_.size(), columns_.size()));
  }
}

}  // namespace scree
