#include "mixing_observer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "plot/axis_map.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"

namespace scree {

namespace {

constexpr const char* kLacey = "lacey_index";
constexpr const char* kNeighbours = "neighbour_index";

std::vector<SeriesColumn> columns() {
  return {{"time", "s"},
          {kLacey, ""},
          {"lacey_random_width", ""},
          {"variance", ""},
          {"variance_segregated", ""},
          {"variance_random", ""},
          {"share_of_first", ""},
          {"cells", ""},
          {"particles_in_cells", ""},
          {kNeighbours, ""},
          {"neighbours_per_particle", ""},
          {"particles", ""}};
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "none"; }

}  // namespace

MixingObserver::MixingObserver(const Options& options) : options_{options}, lacey_{0, 1, false} {}

std::vector<Parameter> MixingObserver::parameters() {
  std::vector<Parameter> all = TwoClasses::parameters();
  std::vector<Variant> neighbours{
      {"none", "no index by neighbours", {}},
      {"nearest",
       "so many nearest particles, by distance of the centres",
       {Parameter::integer("count", "neighbours of a particle").at_least(1).by_default(12)}},
      {"within",
       "all particles within a distance",
       {Parameter::number("reach", "1", "largest distance of the centres over the sum of the radii")
            .above(0.0)
            .by_default(1.2)}}};
  std::vector<Parameter> own{
      CellGrid::parameter(),
      Parameter::choice("weight", {"number", "mass"}, "what shares and samples are counted by in Lacey's index")
          .by_default("number"),
      Parameter::integer("min_particles", "cells with fewer particles are no samples").at_least(1).by_default(5),
      Parameter::variant("neighbours", std::move(neighbours), "who is a neighbour in the index that needs no grid")
          .by_default("nearest"),
      Parameter::number("fit_from", "s", "begin of the window in which the mixing rate is fitted")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("fit_to", "s", "end of that window; the end of the run when left out").optional(),
      Schedule::parameter(0.1)};
  for (Parameter& parameter : own) all.push_back(std::move(parameter));
  return all;
}

void MixingObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  if (options_.has("fit_to") && options_.number("fit_to") <= options_.number("fit_from")) {
    throw options_.error("fit_to", fmt::format("must be later than fit_from = {:g} s", options_.number("fit_from")));
  }
  executor_ = &services.executor();
  schedule_ = Schedule{options_, services.time_step()};
  classes_ = TwoClasses{options_, services};
  grid_ = CellGrid{options_, services};
  lacey_ = Lacey{grid_.size(), static_cast<std::uint64_t>(options_.integer("min_particles")),
                 options_.text("weight") == "mass"};
  const Options& neighbours = options_.table("neighbours");
  neighbours_wanted_ = neighbours.type() != "none";
  if (neighbours.type() == "nearest") neighbourhood_ = {static_cast<std::size_t>(neighbours.integer("count")), 0.0};
  if (neighbours.type() == "within") neighbourhood_ = {0, neighbours.number("reach")};
  stem_ = Stem{"mixing", services, results, {".csv", ".svg", ".png"}};
  series_.open(stem_.table(), columns());
}

void MixingObserver::observe(const Observation& now, Attributes&) {
  classes_.look(now.bodies, now.time);
  if (series_.rows() == 0 || schedule_.is_due(now.step)) look(now);
}

void MixingObserver::look(const Observation& now) {
  grid_.update(now.bodies);
  particles_.clear();
  placed_.clear();
  const std::vector<BodyClass>& classes = classes_.of_dynamic();
  std::size_t dynamic = 0;
  for (std::size_t i = 0; i < now.bodies.size(); ++i) {
    if (now.bodies.motion[i] != Motion::dynamic) continue;
    const BodyClass of = classes[dynamic++];
    if (of == BodyClass::neither) continue;
    particles_.push_back({grid_.cell(now.bodies.position[i]), of, now.bodies.mass[i]});
    placed_.push_back({now.bodies.position[i], now.bodies.radius[i], of});
  }
  const LaceyIndex lacey = lacey_.index(particles_);
  NeighbourIndex neighbours{std::nan(""), std::nan("")};
  if (neighbours_wanted_) neighbours = neighbour_index(placed_, neighbourhood_, *executor_);
  series_.add({now.time, lacey.value, lacey.width, lacey.variance, lacey.variance_segregated, lacey.variance_random,
               lacey.share, static_cast<double>(lacey.cells), static_cast<double>(lacey.particles), neighbours.value,
               neighbours.coordination, static_cast<double>(placed_.size())});
}

Decay MixingObserver::decay_of(const char* index) const {
  const std::vector<double> time = series_.column("time"), value = series_.column(index);
  std::vector<double> t, unmixed;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const bool late = options_.has("fit_to") && time[i] > options_.number("fit_to");
    if (time[i] < options_.number("fit_from") || late || !std::isfinite(value[i])) continue;
    t.push_back(time[i]);
    unmixed.push_back(1.0 - value[i]);
  }
  return fit_decay(t, unmixed);
}

plot::Figure MixingObserver::figure() const {
  plot::Figure figure;
  figure.title = fmt::format("Mixing of {} and {}", classes_.names()[0], classes_.names()[1]);
  figure.x = {"time [s]"};
  figure.y = {"mixing index [1]", plot::Scale::linear, std::pair{0.0, 1.1}};
  const std::vector<double> time = series_.column("time");
  for (const auto& [name, label] : {std::pair{kLacey, "Lacey, by cells"}, std::pair{kNeighbours, "by neighbours"}}) {
    if (name == kNeighbours && !neighbours_wanted_) continue;
    figure.series.push_back({label, plot::SeriesStyle::points, time, series_.column(name)});
    figure.y.range = plot::range_with(*figure.y.range, figure.series.back().y);
    const Decay decay = decay_of(name);
    if (!decay.found) continue;
    plot::Series curve{
        fmt::format("1 - C exp(-t / {:.3g} s)", decay.time_constant.value), plot::SeriesStyle::line, {}, {}};
    const double from = std::max(time.front(), options_.number("fit_from"));
    const double to = options_.has("fit_to") ? options_.number("fit_to") : time.back();
    for (int k = 0; k <= 200; ++k) {
      const double t = from + (to - from) * k / 200;
      curve.x.push_back(t);
      curve.y.push_back(1.0 - decay.amplitude * std::exp(-(t - decay.begin) / decay.time_constant.value));
    }
    figure.series.push_back(std::move(curve));
  }
  return figure;
}

void MixingObserver::finish(const Observation& last) {
  if (series_.wants(last.time)) {
    classes_.look(last.bodies, last.time);
    look(last);
  }
  if (stem_.writes()) plot::write_figure(figure(), stem_.figure());
}

std::vector<ReportTable> MixingObserver::report() const {
  ReportTable table;
  table.title = fmt::format("Mixing of {} and {}", classes_.names()[0], classes_.names()[1]);
  table.header = {"index", "at the start", "at the end", "random mixture", "time constant [s]", "left by the fit"};
  const auto add = [&](const char* name, const char* label, const std::string& random) {
    const std::vector<double> values = series_.column(name);
    const Decay decay = decay_of(name);
    table.rows.push_back({label, values.empty() ? "none" : number(values.front()),
                          values.empty() ? "none" : number(values.back()), random,
                          decay.found
                              ? fmt::format("{:.4g} +- {:.2g}", decay.time_constant.value, decay.time_constant.error)
                              : "no decay found",
                          decay.found ? number(decay.residual) : ""});
  };
  const std::vector<double> width = series_.column("lacey_random_width");
  add(kLacey, "Lacey, by cells", width.empty() ? "1" : fmt::format("1 +- {}", number(width.back())));
  if (neighbours_wanted_) add(kNeighbours, "by neighbours", "1");
  return {table};
}

void MixingObserver::save(StateWriter& out) const {
  classes_.save(*out.group("classes"));
  series_.save(out, "series");
}

void MixingObserver::load(const StateReader& in) {
  classes_.load(*in.group("classes"));
  series_.load(in, "series");
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::MixingObserver>(
      "mixing", "How well two classes of particles are mixed, by cells and by neighbours, and how fast.",
      scree::MixingObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("mixing", "1.0.0", &list)};
