#include "series_log.hpp"

#include "scree/state/state_io.hpp"

namespace scree {

void SeriesLog::open(const std::filesystem::path& file, const std::vector<std::string>& category_names) {
  names_ = category_names;
  if (file.empty()) return;
  table_.emplace(file,
                 std::vector<CsvColumn>{{"time", "s"}, {"material", ""}, {"bin", ""}, {"number", ""}, {"mass", "kg"}});
}

void SeriesLog::write(const Row& row) {
  if (!table_) return;
  table_->cell(row.time).cell(names_[row.category]).cell(row.bin).cell(row.amount.number).cell(row.amount.mass);
  table_->end_row();
}

void SeriesLog::end_interval(double time) {
  for (std::size_t category = 0; category < window_.categories(); ++category) {
    for (std::size_t bin = 0; bin < window_.columns(); ++bin) {
      const Tally& amount = window_.at(category, bin);
      if (amount.number == 0) continue;
      rows_.push_back({time, category, bin, amount});
      write(rows_.back());
    }
  }
  window_ = TallyTable{window_.categories(), window_.columns()};
}

void SeriesLog::save(StateWriter& out) const {
  window_.save(out, "window");
  std::vector<double> time, mass;
  std::vector<std::uint64_t> category, bin, number;
  for (const Row& row : rows_) {
    time.push_back(row.time);
    category.push_back(row.category);
    bin.push_back(row.bin);
    number.push_back(row.amount.number);
    mass.push_back(row.amount.mass);
  }
  out.write("time", time);
  out.write("category", category);
  out.write("bin", bin);
  out.write("number", number);
  out.write("mass", mass);
}

void SeriesLog::load(const StateReader& in) {
  window_.load(in, "window");
  const auto time = in.doubles("time"), mass = in.doubles("mass");
  const auto category = in.integers("category"), bin = in.integers("bin"), number = in.integers("number");
  rows_.clear();
  for (std::size_t i = 0; i < time.size(); ++i) {
    rows_.push_back({time[i], category.at(i), bin.at(i), {number.at(i), mass.at(i)}});
    write(rows_.back());
  }
}

}  // namespace scree
