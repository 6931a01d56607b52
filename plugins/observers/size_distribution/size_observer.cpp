#include "size_observer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"

namespace scree {

SizeObserver::SizeObserver(const Options& options) : options_{options} {
  const Options& classes = options.table("classes");
  if (classes.number("largest") <= classes.number("smallest")) {
    throw classes.error("largest", fmt::format("must be above smallest = {:g} m", classes.number("smallest")));
  }
  edges_ = size_classes(classes.number("smallest"), classes.number("largest"),
                        static_cast<std::size_t>(classes.integer("count")), classes.text("spacing") == "logarithmic");
}

std::vector<Parameter> SizeObserver::parameters() {
  return {
      Region::parameter(),
      Parameter::texts("materials", "materials that count; all when left out").by_default(std::vector<std::string>{}),
      Parameter::table("classes",
                       {Parameter::number("smallest", "m", "lower edge of the first class of diameters").above(0.0),
                        Parameter::number("largest", "m", "upper edge of the last class").above(0.0),
                        Parameter::integer("count", "number of classes").at_least(1).at_most(10000).by_default(20),
                        Parameter::choice("spacing", {"linear", "logarithmic"},
                                          "what is equal for all classes: "
                                          "their width, or the ratio of their edges")
                            .by_default("linear")},
                       "classes of the histogram"),
      Schedule::parameter(0.1)};
}

void SizeObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  region_ = Region{options_, services};
  schedule_ = Schedule{options_, services.time_step()};
  stem_ = Stem{"size_distribution",
               services,
               results,
               {".csv", "_histogram.csv", ".svg", ".png", "_over_time.svg", "_over_time.png"}};
  const std::vector<std::string>& materials = options_.texts("materials");
  counts_.assign(services.materials().size(), materials.empty() ? 1 : 0);
  for (const std::string& name : materials) counts_[services.material(name)] = 1;
  numbers_.open(stem_.table(), {{"time", "s"},
                                {"number"},
                                {"mass", "kg"},
                                {"d10", "m"},
                                {"d50", "m"},
                                {"d90", "m"},
                                {"d10_number", "m"},
                                {"d50_number", "m"},
                                {"d90_number", "m"},
                                {"d32", "m"},
                                {"smallest", "m"},
                                {"largest", "m"},
                                {"number_below_classes"},
                                {"number_above_classes"}});
  classes_.open(stem_.table("histogram"), {{"time", "s"},
                                           {"from", "m"},
                                           {"to", "m"},
                                           {"number"},
                                           {"mass", "kg"},
                                           {"share_by_number"},
                                           {"share_by_mass"},
                                           {"cumulative_by_number"},
                                           {"cumulative_by_mass"}});
}

void SizeObserver::observe(const Observation& now, Attributes&) {
  if (numbers_.rows() == 0 || schedule_.is_due(now.step)) look(now);
}

void SizeObserver::look(const Observation& now) {
  region_.update(now.bodies);
  particles_.clear();
  for (std::size_t i = 0; i < now.bodies.size(); ++i) {
    if (now.bodies.motion[i] != Motion::dynamic || counts_[now.bodies.material[i]] == 0) continue;
    if (!region_.contains(now.bodies.position[i])) continue;
    particles_.push_back({2.0 * now.bodies.radius[i], now.bodies.mass[i]});
  }
  sizes_.assign(particles_);
  fill_histogram(particles_, edges_, histogram_);
  const SizeNumbers n = sizes_.numbers();
  numbers_.add({now.time, n.number, n.mass, n.d10, n.d50, n.d90, n.d10_number, n.d50_number, n.d90_number, n.d32,
                n.smallest, n.largest, histogram_.below.number, histogram_.above.number});
  add_histogram(now.time);
}

void SizeObserver::add_histogram(double time) {
  SizeHistogram::Amount all = histogram_.below, below = histogram_.below;
  for (const auto& amounts : {std::span<const SizeHistogram::Amount>{histogram_.in_class},
                              std::span<const SizeHistogram::Amount>{&histogram_.above, 1}}) {
    for (const SizeHistogram::Amount& amount : amounts) {
      all.number += amount.number;
      all.mass += amount.mass;
    }
  }
  const auto share = [](double part, double whole) { return whole > 0.0 ? part / whole : 0.0; };
  for (std::size_t k = 0; k + 1 < edges_.size(); ++k) {
    const SizeHistogram::Amount& amount = histogram_.in_class[k];
    below.number += amount.number;
    below.mass += amount.mass;
    classes_.add({time, edges_[k], edges_[k + 1], amount.number, amount.mass, share(amount.number, all.number),
                  share(amount.mass, all.mass), share(below.number, all.number), share(below.mass, all.mass)});
  }
}

plot::Figure SizeObserver::curves() const {
  plot::Figure figure;
  const auto scale =
      options_.table("classes").text("spacing") == "logarithmic" ? plot::Scale::logarithmic : plot::Scale::linear;
  figure.title = "Size distribution" + region_.frame().label();
  figure.x = {"diameter [m]", scale, std::pair{edges_.front(), edges_.back()}};
  figure.y = {"cumulative share [%]", plot::Scale::linear, std::pair{0.0, 100.0}};
  const double first = numbers_.first_of("time").front(), last = numbers_.last_of("time").front();
  figure.note = fmt::format("at {:g} s and at {:g} s", first, last);
  const auto curve = [&](const char* weight, bool at_end) {
    std::vector<double> to = at_end ? classes_.last_of("to") : classes_.first_of("to");
    std::vector<double> share = at_end ? classes_.last_of(weight) : classes_.first_of(weight);
    for (double& value : share) value *= 100.0;
    return std::pair{std::move(to), std::move(share)};
  };
  for (const auto& [weight, label] :
       {std::pair{"cumulative_by_mass", "by mass"}, std::pair{"cumulative_by_number", "by number"}}) {
    for (const bool at_end : {false, true}) {
      auto [to, share] = curve(weight, at_end);
      figure.series.push_back({fmt::format("{}, at {:g} s", label, at_end ? last : first), plot::SeriesStyle::line,
                               std::move(to), std::move(share)});
    }
  }
  return figure;
}

plot::Figure SizeObserver::over_time() const {
  plot::Figure figure;
  figure.title = "Sizes by mass, and the Sauter mean" + region_.frame().label();
  figure.x = {"time [s]"};
  figure.y = {"diameter [m]"};
  for (const char* name : {"d10", "d50", "d90", "d32"}) {
    figure.series.push_back({name, plot::SeriesStyle::line, numbers_.column("time"), numbers_.column(name)});
  }
  return figure;
}

void SizeObserver::finish(const Observation& last) {
  if (numbers_.wants(last.time)) look(last);
  if (!stem_.writes()) return;
  plot::write_figure(curves(), stem_.figure());
  plot::write_figure(over_time(), stem_.figure("over_time"));
}

std::vector<ReportTable> SizeObserver::report() const {
  ReportTable table;
  table.title = "Size distribution" + region_.frame().label();
  table.header = {"at",      "number",  "mass [kg]", "d10 [m]",          "d50 [m]",
                  "d90 [m]", "d32 [m]", "span [1]",  "d50 by number [m]"};
  if (numbers_.rows() == 0) return {table};
  for (const bool at_end : {false, true}) {
    const auto value = [&](const char* name) {
      return (at_end ? numbers_.last_of(name) : numbers_.first_of(name)).front();
    };
    const auto text = [&](double number) { return std::isfinite(number) ? fmt::format("{:.4g}", number) : "none"; };
    table.rows.push_back({fmt::format("{:g} s", value("time")), fmt::format("{}", value("number")), text(value("mass")),
                          text(value("d10")), text(value("d50")), text(value("d90")), text(value("d32")),
                          text((value("d90") - value("d10")) / value("d50")), text(value("d50_number"))});
  }
  return {table};
}

void SizeObserver::save(StateWriter& out) const {
  numbers_.save(out, "numbers");
  classes_.save(out, "classes");
}

void SizeObserver::load(const StateReader& in) {
  numbers_.load(in, "numbers");
  classes_.load(in, "classes");
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::SizeObserver>("size_distribution",
                                                    "Sizes of the particles in a region, by number and by mass.",
                                                    scree::SizeObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("size_distribution", "1.0.0", &list)};
