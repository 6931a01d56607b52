#include "scree/machine/functions/time_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "scree/geometry/number_table.hpp"

namespace scree {
namespace {

void check_row(const NumberRow& row, std::span<const std::size_t> columns, const std::string& names,
               const SourceLocation& where, const TimeSeries& before) {
  const auto refuse = [&](const std::string& sentence) { throw Error{ErrorKind::usage, where, sentence}; };
  if (!row.bad_word.empty()) {
    refuse(fmt::format("'{}' is no number; a row has {}", row.bad_word.substr(0, 40), names));
  }
  for (const double number : row.numbers) {
    if (!std::isfinite(number)) refuse(fmt::format("{} is no finite number; a row has {}", number, names));
  }
  const std::size_t found = row.numbers.size() - 1;
  if (std::ranges::find(columns, found) == columns.end()) {
    refuse(fmt::format("the row has {} numbers; it needs {}", found + 1, names));
  }
  if (before.times.empty()) return;
  if (found != before.columns) {
    refuse(fmt::format("the row has {} numbers, but those before it have {}", found + 1, before.columns + 1));
  }
  if (row.numbers.front() <= before.times.back()) {
    refuse(fmt::format("the time {} s does not come after {} s of the row before; times must ascend",
                       row.numbers.front(), before.times.back()));
  }
}

}  // namespace

TimeSeries read_time_series(const std::filesystem::path& file, std::span<const std::size_t> columns,
                            const std::string& names, const SourceLocation& where) {
  std::ifstream in{file};
  if (!in) throw Error{ErrorKind::io, where, "the file " + file.string() + " cannot be read; does it exist?"};
  TimeSeries series;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const NumberRow row = read_numbers(line);
    const bool is_heading = number == 1 && row.numbers.empty();
    if (is_heading || (row.numbers.empty() && row.bad_word.empty())) continue;
    check_row(row, columns, names, {file.string(), number, 0}, series);
    series.columns = row.numbers.size() - 1;
    series.times.push_back(row.numbers.front());
    series.lines.push_back(number);
    series.values.insert(series.values.end(), row.numbers.begin() + 1, row.numbers.end());
  }
  if (series.times.size() < 2) {
    throw Error{ErrorKind::usage, where,
                "the file " + file.string() + " has " + std::to_string(series.times.size()) +
                    " rows of numbers; two are the least"};
  }
  return series;
}

}  // namespace scree
