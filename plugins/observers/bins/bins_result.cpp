#include "bins_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scree/results/csv.hpp"

namespace scree {

std::size_t Categories::find(const std::string& name) const {
  return static_cast<std::size_t>(std::find(names.begin() + 1, names.end(), name) - names.begin());
}

std::size_t ProductPlan::product(double distance) const {
  return static_cast<std::size_t>(std::upper_bound(splitters.begin(), splitters.end(), distance) - splitters.begin());
}

std::vector<std::size_t> BinsResult::shown() const {
  std::vector<std::size_t> list;
  for (std::size_t c = 1; c < categories.names.size(); ++c) {
    if (tracker.fed().at(c).number > 0) list.push_back(c);
  }
  return list;
}

std::vector<std::size_t> BinsResult::judged() const {
  const std::vector<std::size_t>& aliased = categories.aliased;
  const bool targets = categories.first_target < categories.names.size() || !aliased.empty();
  std::vector<std::size_t> list;
  for (const std::size_t c : shown()) {
    const bool alias = std::find(aliased.begin(), aliased.end(), c) != aliased.end();
    if (!targets || alias || c >= categories.first_target) list.push_back(c);
  }
  return list;
}

ReadableAxis readable_axis(const Collector& collector) {
  const Vec3& u = collector.u();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(u[axis]) > (1.0 - 1e-9) * norm(u))
      return {std::string(1, "xyz"[axis]), collector.origin()[axis], u[axis]};
  }
  return {"u", 0.0, norm(u)};
}

void write_bins_table(const BinsResult& result, const std::filesystem::path& file) {
  const Collector& c = result.collector;
  std::vector<CsvColumn> columns{{"bin", ""},      {"u_lower", "m"}, {"u_upper", "m"}, {"v_lower", "m"},
                                 {"v_upper", "m"}, {"x", "m"},       {"y", "m"},       {"z", "m"}};
  std::vector<std::size_t> shown = result.shown();
  shown.push_back(0);
  for (const std::size_t category : shown) {
    columns.push_back({"number_" + result.categories.names[category], ""});
    columns.push_back({"mass_" + result.categories.names[category], "kg"});
  }
  CsvWriter table{file, columns};
  for (std::size_t bin = 0; bin < c.bins(); ++bin) {
    const std::size_t row = bin / static_cast<std::size_t>(c.u_bins());
    const auto iu = static_cast<double>(bin % static_cast<std::size_t>(c.u_bins())), iv = static_cast<double>(row);
    const double du = norm(c.u()) / c.u_bins(), dv = norm(c.v()) / c.v_bins();
    const Vec3 centre = c.origin() + (iu + 0.5) / c.u_bins() * c.u() + (iv + 0.5) / c.v_bins() * c.v();
    table.cell(std::uint64_t{bin}).cell(iu * du).cell((iu + 1.0) * du).cell(iv * dv).cell((iv + 1.0) * dv);
    table.cell(centre.x).cell(centre.y).cell(centre.z);
    for (const std::size_t category : shown) {
      table.cell(result.bins.at(category, bin).number).cell(result.bins.at(category, bin).mass);
    }
    table.end_row();
  }
  table.close();
}

void write_ledger(const BinsResult& result, const std::filesystem::path& file) {
  const std::vector<std::string> states{"fed", "in_flight", "lost", "collected"};
  std::vector<CsvColumn> columns{{"material", ""}};
  for (const std::string& state : states) columns.push_back({"number_" + state, ""});
  for (const std::string& state : states) columns.push_back({"mass_" + state, "kg"});
  CsvWriter table{file, columns};
  const TallyTable in_flight = result.tracker.in_flight();
  std::vector<std::size_t> rows = result.shown();
  rows.push_back(0);
  for (const std::size_t c : rows) {
    const std::array amounts{result.tracker.fed().at(c), in_flight.at(c), result.tracker.lost(c),
                             result.tracker.binned().at(c)};
    table.cell(result.categories.names[c]);
    for (const Tally& amount : amounts) table.cell(amount.number);
    for (const Tally& amount : amounts) table.cell(amount.mass);
    table.end_row();
  }
  table.close();
}

namespace {

// The strips along u that hold nearly everything, and the splitters, as shares of u; the whole when nothing lies in bins.
std::pair<double, double> shown_part(const BinsResult& result) {
  constexpr double kStray = 1e-3, kMargin = 0.2;  // of a category's mass; of the part
  const auto strips = static_cast<std::size_t>(result.collector.u_bins());
  double first = 1.0, last = 0.0;
  const auto show = [&](double from, double to) {
    first = std::min(first, from);
    last = std::max(last, to);
  };
  for (const std::size_t category : result.judged()) {
    std::vector<double> mass(strips, 0.0);
    for (std::size_t bin = 0; bin < result.bins.columns(); ++bin)
      mass[bin % strips] += result.bins.at(category, bin).mass;
    const double stray = kStray * result.bins.sum(category).mass;
    for (std::size_t strip = 0; strip < strips; ++strip) {
      const double edge = static_cast<double>(strip), count = static_cast<double>(strips);
      if (mass[strip] > stray) show(edge / count, (edge + 1.0) / count);
    }
  }
  if (first > last) return {0.0, 1.0};
  for (const double splitter : result.plan.splitters) {
    const double share = splitter / norm(result.collector.u());
    show(share, share);
  }
  const double margin = kMargin * (last - first);
  return {std::max(0.0, first - margin), std::min(1.0, last + margin)};
}

}  // namespace

plot::Figure bins_figure(const BinsResult& result) {
  const ReadableAxis axis = readable_axis(result.collector);
  const auto strips = static_cast<std::size_t>(result.collector.u_bins());
  const auto edge = [&](double fraction) { return axis.at_origin + fraction * axis.per_u; };
  const std::pair<double, double> shown = shown_part(result);
  plot::Figure figure;
  figure.title = "Output distribution: " + result.name;
  figure.note = fmt::format("{} bodies collected in {:g} s", result.tracker.binned().at(0).number, result.time);
  figure.x = {axis.name == "u" ? "distance along the collector [m]" : axis.name + " [m]", plot::Scale::linear,
              std::minmax({edge(shown.first), edge(shown.second)})};
  figure.y = {"share of the material's collected mass per bin [%]"};
  for (const std::size_t category : result.judged()) {
    const Tally total = result.bins.sum(category);
    plot::Series series{fmt::format("{} ({:.4g} kg)", result.categories.names[category], total.mass),
                        plot::SeriesStyle::steps,
                        {},
                        std::vector<double>(strips, 0.0)};
    for (std::size_t e = 0; e <= strips; ++e) {
      series.x.push_back(edge(static_cast<double>(e) / static_cast<double>(strips)));
    }
    for (std::size_t bin = 0; bin < result.bins.columns() && total.mass > 0.0; ++bin) {
      series.y[bin % strips] += 100.0 * result.bins.at(category, bin).mass / total.mass;
    }
    figure.series.push_back(std::move(series));
  }
  const double length = norm(result.collector.u());
  double from = 0.0;
  for (std::size_t p = 0; p < result.plan.names.size() && !result.plan.splitters.empty(); ++p) {
    const bool last = p == result.plan.splitters.size();
    const double to = last ? 1.0 : result.plan.splitters[p] / length;
    if (!last) figure.lines.push_back({edge(to), "splitter"});
    const auto [low, high] = std::minmax({edge(from), edge(to)});
    figure.regions.push_back({low, high, result.plan.names[p]});
    from = to;
  }
  return figure;
}

}  // namespace scree
