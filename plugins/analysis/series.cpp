#include "analysis/series.hpp"

#include <algorithm>

#include "scree/base/require.hpp"
#include "scree/config/options.hpp"

namespace scree {

Parameter Schedule::parameter(double interval, std::string help) {
  return Parameter::number("interval", "s", std::move(help)).at_least(0.0).by_default(interval);
}

Schedule::Schedule(const Options& options, double time_step)
    : every_{steps_between(options.number("interval"), time_step)} {}

void Series::open(const std::filesystem::path& file, std::vector<SeriesColumn> columns) {
  names_.clear();
  for (const SeriesColumn& column : columns) names_.push_back(column.name);
  table_.emplace(std::move(columns));
  if (!file.empty()) table_->open(file);
}

std::size_t Series::index(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  SCREE_REQUIRE(found != names_.end(), "the table has no such column");
  return static_cast<std::size_t>(found - names_.begin());
}

std::vector<double> Series::last_of(std::string_view name) const {
  return rows() == 0 ? std::vector<double>{} : table_->column(index(name), 0, table_->value(rows() - 1, 0));
}

std::vector<double> Series::first_of(std::string_view name) const {
  return rows() == 0 ? std::vector<double>{} : table_->column(index(name), 0, table_->value(0, 0));
}

void Series::leave_out(std::span<const std::string> columns) {
  if (columns.empty()) return;
  std::vector<char> left_out(names_.size(), 0);
  for (const std::string& name : columns) left_out[index(name)] = 1;
  table_->close_without(left_out);
}

}  // namespace scree
