#include "residence_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

ResidenceObserver::ResidenceObserver(const Options& options) : options_{options} {}

std::vector<Parameter> ResidenceObserver::parameters() {
  return {
      Region::parameter(),
      Schedule::parameter(0.05, "of the table of what is inside; rounded to whole steps"),
      Parameter::choice("weight", {"number", "mass"}, "what the distribution counts bodies by").by_default("number"),
      Parameter::boolean("count_initial", "what is there at the first look counts from then on; else it is left out")
          .by_default(true),
      Parameter::number("shortest", "s", "shorter stays are dropped: bodies that jitter at the border")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::integer("bins", "of the distribution").at_least(1).at_most(10000).by_default(40)};
}

void ResidenceObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  schedule_ = Schedule{options_, services.time_step()};
  stem_ = Stem{"residence_time", services, results, {".csv", "_stays.csv", "_distribution.csv", ".svg", ".png"}};
  materials_ = services.materials().names();
  stays_ = std::make_unique<Stays>(Region{options_, services}, options_.boolean("count_initial"));
  hold_up_.open(stem_.table(),
                {{"time", "s"}, {"number_inside"}, {"mass_inside", "kg"}, {"longest_inside", "s"}, {"stays_ended"}});
  ended_.open(
      stem_.table("stays"),
      {{"left", "s"}, {"id"}, {"material", "", materials_}, {"mass", "kg"}, {"entered", "s"}, {"residence_time", "s"}});
}

void ResidenceObserver::look(const Observation& now) {
  ended_now_.clear();
  stays_->look(now, ended_now_);
  for (const Stay& stay : ended_now_) {
    if (stay.duration() < options_.number("shortest")) continue;
    ended_.add({stay.left, static_cast<double>(stay.id), static_cast<double>(stay.material), stay.mass, stay.entered,
                stay.duration()});
  }
}

void ResidenceObserver::add_row(double time) {
  const HoldUp& hold_up = stays_->hold_up();
  hold_up_.add(
      {time, static_cast<double>(hold_up.number), hold_up.mass, hold_up.oldest, static_cast<double>(ended_.rows())});
}

void ResidenceObserver::observe(const Observation& now, Attributes&) {
  look(now);
  if (schedule_.is_due(now.step)) add_row(now.time);
}

void ResidenceObserver::finish(const Observation& last) {
  Observation end = last;
  end.dt = 0.0;  // nothing moved since the last step, but sinks may have taken bodies out
  look(end);
  if (hold_up_.wants(last.time)) add_row(last.time);
  if (!stem_.writes() || ended_.rows() == 0) return;
  const std::vector<Kind> all = kinds();
  write_distribution(all);
  plot::write_figure(figure(all), stem_.figure());
}

std::vector<ResidenceObserver::Kind> ResidenceObserver::kinds() const {
  std::vector<Kind> kinds(materials_.size() + 1);
  kinds[0].name = "all";
  for (std::size_t m = 0; m < materials_.size(); ++m) kinds[m + 1].name = materials_[m];
  const std::vector<double> time = ended_.column("residence_time"), mass = ended_.column("mass"),
                            material = ended_.column("material");
  const bool by_mass = options_.text("weight") == "mass";
  for (std::size_t k = 0; k < time.size(); ++k) {
    const Weighted one{time[k], by_mass ? mass[k] : 1.0};
    kinds[0].times.push_back(one);
    kinds[static_cast<std::size_t>(material[k]) + 1].times.push_back(one);
  }
  std::erase_if(kinds, [](const Kind& kind) { return kind.times.empty() && kind.name != "all"; });
  if (kinds.size() == 2) kinds.pop_back();  // one material is all
  return kinds;
}

std::vector<double> ResidenceObserver::edges(const std::vector<Kind>& kinds) const {
  double longest = 0.0;
  for (const Weighted& time : kinds[0].times) longest = std::max(longest, time.value);
  const auto bins = static_cast<std::size_t>(options_.integer("bins"));
  std::vector<double> edges(bins + 1);
  for (std::size_t e = 0; e <= bins; ++e) edges[e] = longest * static_cast<double>(e) / static_cast<double>(bins);
  edges.back() = longest;
  return edges;
}

void ResidenceObserver::write_distribution(const std::vector<Kind>& kinds) const {
  std::vector<CsvColumn> columns{{"from", "s"}, {"to", "s"}};
  std::vector<std::vector<double>> density;
  const std::vector<double> edge = edges(kinds);
  for (const Kind& kind : kinds) {
    columns.push_back({"density_" + lower_snake(kind.name), "1/s"});
    columns.push_back({"cumulative_" + lower_snake(kind.name), ""});
    density.push_back(density_of(kind.times, edge));
  }
  CsvWriter table{stem_.table("distribution"), columns};
  std::vector<double> below(kinds.size(), 0.0);
  for (std::size_t b = 0; b + 1 < edge.size(); ++b) {
    table.cell(edge[b]).cell(edge[b + 1]);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      below[k] += density[k][b] * (edge[b + 1] - edge[b]);
      table.cell(density[k][b]).cell(below[k]);
    }
    table.end_row();
  }
  table.close();
}

plot::Figure ResidenceObserver::figure(const std::vector<Kind>& kinds) const {
  plot::Figure figure;
  const Residence all = residence_of(kinds[0].times);
  figure.title = "Residence time";
  figure.note = fmt::format("{} stays, mean {:.4g} s, variance {:.3g} s2, {:.3g} tanks in series", all.count, all.mean,
                            all.variance, all.tanks);
  figure.x = {"residence time [s]"};
  figure.y = {options_.text("weight") == "mass" ? "share of mass per time [1/s]" : "share of bodies per time [1/s]"};
  const std::vector<double> edge = edges(kinds);
  for (const Kind& kind : kinds) {
    figure.series.push_back({kind.name, plot::SeriesStyle::steps, edge, density_of(kind.times, edge)});
  }
  if (!(all.tanks >= 1.0) || !std::isfinite(all.tanks)) return figure;
  plot::Series model{"as many tanks", plot::SeriesStyle::line, {}, {}};
  for (int k = 0; k <= 300; ++k) {
    model.x.push_back(edge.back() * k / 300);
    model.y.push_back(tanks_in_series(model.x.back(), all.mean, all.tanks));
  }
  figure.series.push_back(std::move(model));
  return figure;
}

std::vector<ReportTable> ResidenceObserver::report() const {
  ReportTable table;
  table.title = fmt::format("Residence time by {} ({} bodies inside at the end, the longest for {:.4g} s)",
                            options_.text("weight"), stays_->hold_up().number, stays_->hold_up().oldest);
  table.header = {"material", "stays", "mean [s]", "variance [s2]", "tanks in series", "t10 [s]", "t50 [s]", "t90 [s]"};
  for (const Kind& kind : kinds()) {
    const Residence r = residence_of(kind.times);
    const auto number = [](double value) { return std::isnan(value) ? "none" : fmt::format("{:.4g}", value); };
    table.rows.push_back({kind.name, fmt::format("{}", r.count),
                          std::isnan(r.error) ? number(r.mean) : fmt::format("{:.4g} +- {:.2g}", r.mean, r.error),
                          number(r.variance), number(r.tanks), number(r.t10), number(r.t50), number(r.t90)});
  }
  return {table};
}

void ResidenceObserver::save(StateWriter& out) const {
  stays_->save(*out.group("bodies"));
  hold_up_.save(out, "hold_up");
  ended_.save(out, "stays");
}

void ResidenceObserver::load(const StateReader& in) {
  stays_->load(*in.group("bodies"));
  hold_up_.load(in, "hold_up");
  ended_.load(in, "stays");
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::ResidenceObserver>("residence_time",
                                                         "How long bodies stay in a region or in the simulation.",
                                                         scree::ResidenceObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("residence_time", "1.0.0", &list)};
