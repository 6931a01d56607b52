#include "segregation_observer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

SegregationObserver::SegregationObserver(const Options& options)
    : options_{options}, axis_{normalized(options.vector("axis"))} {
  if (axis_ == Vec3{}) throw options.error("axis", "must not be zero; [0, 0, 1] looks along z");
  if (options.number("to") <= options.number("from")) {
    throw options.error("to", fmt::format("must be above from = {:g} m", options.number("from")));
  }
}

std::vector<Parameter> SegregationObserver::parameters() {
  std::vector<Parameter> all = TwoClasses::parameters();
  std::vector<Parameter> own{
      Parameter::vector("axis", "1", "direction along which particles part, of any length, in the frame of the region"),
      Parameter::number("from", "m", "where the profile begins, along the axis from the origin of the frame"),
      Parameter::number("to", "m", "where the profile ends"),
      Parameter::integer("bins", "of the profile").at_least(1).at_most(10000).by_default(20),
      Region::parameter(),
      Schedule::parameter(0.1)};
  for (Parameter& parameter : own) all.push_back(std::move(parameter));
  return all;
}

void SegregationObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  region_ = Region{options_, services};
  schedule_ = Schedule{options_, services.time_step()};
  stem_ =
      Stem{"segregation", services, results, {".csv", "_profile.csv", ".svg", ".png", "_profile.svg", "_profile.png"}};
  classes_ = TwoClasses{options_, services};
  materials_ = GrainMaterials{services.materials()};
  bins_ = std::make_unique<AxisProfile>(options_.number("from"), options_.number("to"),
                                        static_cast<std::size_t>(options_.integer("bins")), materials_.size());
  const auto& names = classes_.names();
  series_.open(stem_.table(), {{"time", "s"},
                               {"centre_" + names[0], "m"},
                               {"centre_" + names[1], "m"},
                               {"difference", "m"},
                               {"segregation_index"},
                               {"segregation_intensity"},
                               {"size_correlation"},
                               {"density_correlation"},
                               {"particles"}});
  std::vector<SeriesColumn> columns{{"time", "s"},        {"from", "m"},           {"to", "m"},
                                    {"number"},           {"mass", "kg"},          {"mean_diameter", "m"},
                                    {"density", "kg/m3"}, {"share_of_" + names[0]}};
  for (const std::string& material : materials_.names())
    columns.push_back({"share_of_material_" + lower_snake(material)});
  profiles_.open(stem_.table("profile"), std::move(columns));
}

void SegregationObserver::observe(const Observation& now, Attributes&) {
  classes_.look(now.bodies, now.time);
  if (series_.rows() == 0 || schedule_.is_due(now.step)) look(now);
}

void SegregationObserver::look(const Observation& now) {
  region_.update(now.bodies);
  particles_.clear();
  std::size_t dynamic = 0;
  for (std::size_t i = 0; i < now.bodies.size(); ++i) {
    if (now.bodies.motion[i] != Motion::dynamic) continue;
    materials_.see(now.bodies.material[i]);
    const BodyClass of = classes_.of_dynamic()[dynamic++];
    if (!region_.contains(now.bodies.position[i])) continue;
    const double r = now.bodies.radius[i], volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
    particles_.push_back({dot(axis_, region_.local(now.bodies.position[i])), now.bodies.mass[i], 2.0 * r,
                          now.bodies.mass[i] / volume, of, now.bodies.material[i]});
  }
  const Separation s = bins_->look(particles_);
  series_.add({now.time, s.first_centre, s.second_centre, s.difference, s.index, s.intensity, s.size_correlation,
               s.density_correlation, static_cast<double>(particles_.size())});
  add_profile(now.time);
}

void SegregationObserver::add_profile(double time) {
  const auto share = [](double part, double whole) {
    return whole > 0.0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<double> row;
  for (std::size_t b = 0; b < bins_->bins().size(); ++b) {
    const ProfileBin& bin = bins_->bins()[b];
    row = {time,
           bins_->edge(b),
           bins_->edge(b + 1),
           bin.number,
           bin.mass,
           share(bin.diameters, bin.number),
           share(bin.mass, bin.volume),
           share(bin.first_mass, bin.classed_mass)};
    for (std::size_t m = 0; m < materials_.size(); ++m) row.push_back(share(bins_->material_mass(b, m), bin.mass));
    profiles_.add(row);
  }
}

plot::Figure SegregationObserver::over_time() const {
  plot::Figure figure;
  figure.title = fmt::format("Segregation of {} from {}", classes_.names()[0], classes_.names()[1]);
  figure.note = fmt::format("index 1: all of {} lies towards ({:g}, {:g}, {:g}); -1: away from there",
                            classes_.names()[0], axis_.x, axis_.y, axis_.z);
  figure.x = {"time [s]"};
  figure.y = {"index, intensity, correlation [1]", plot::Scale::linear, std::pair{-1.0, 1.0}};
  const std::vector<double> time = series_.column("time");
  for (const auto& [name, label] :
       {std::pair{"segregation_index", "index"}, std::pair{"segregation_intensity", "intensity"},
        std::pair{"size_correlation", "size and place"}, std::pair{"density_correlation", "density and place"}}) {
    std::vector<double> values = series_.column(name);
    const bool any = std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (any) figure.series.push_back({label, plot::SeriesStyle::line, time, std::move(values)});
  }
  return figure;
}

plot::Figure SegregationObserver::profile() const {
  plot::Figure figure;
  figure.title = fmt::format("Share of {} along the axis", classes_.names()[0]) + region_.frame().label();
  figure.x = {"place along the axis [m]"};
  figure.y = {"share of mass [%]", plot::Scale::linear, std::pair{0.0, 100.0}};
  const std::string share = "share_of_" + classes_.names()[0];
  for (const bool at_end : {false, true}) {
    const auto column = [&](std::string_view name) {
      return at_end ? profiles_.last_of(name) : profiles_.first_of(name);
    };
    std::vector<double> from = column("from"), to = column("to"), values = column(share);
    for (std::size_t b = 0; b < values.size(); ++b) {
      from[b] = 0.5 * (from[b] + to[b]);
      values[b] *= 100.0;
    }
    const double time = column("time").front();
    figure.series.push_back({fmt::format("at {:g} s", time), plot::SeriesStyle::line, from, values});
  }
  return figure;
}

void SegregationObserver::finish(const Observation& last) {
  if (series_.wants(last.time)) {
    classes_.look(last.bodies, last.time);
    look(last);
  }
  profiles_.leave_out(materials_.columns_of_walls("share_of_material_"));
  if (!stem_.writes()) return;
  plot::write_figure(over_time(), stem_.figure());
  plot::write_figure(profile(), stem_.figure("profile"));
}

std::vector<ReportTable> SegregationObserver::report() const {
  ReportTable table;
  table.title = fmt::format("Segregation of {} from {}", classes_.names()[0], classes_.names()[1]);
  table.header = {
      "at", "difference of centres [m]", "index [1]", "intensity [1]", "size and place [1]", "density and place [1]"};
  if (series_.rows() == 0) return {table};
  for (const bool at_end : {false, true}) {
    const auto value = [&](const char* name) {
      return (at_end ? series_.last_of(name) : series_.first_of(name)).front();
    };
    std::vector<std::string> row{fmt::format("{:g} s", value("time"))};
    for (const char* name :
         {"difference", "segregation_index", "segregation_intensity", "size_correlation", "density_correlation"}) {
      row.push_back(std::isfinite(value(name)) ? fmt::format("{:.4g}", value(name)) : "none");
    }
    table.rows.push_back(std::move(row));
  }
  return {table};
}

void SegregationObserver::save(StateWriter& out) const {
  classes_.save(*out.group("classes"));
  materials_.save(out, "materials");
  series_.save(out, "series");
  profiles_.save(out, "profiles");
}

void SegregationObserver::load(const StateReader& in) {
  classes_.load(*in.group("classes"));
  materials_.load(in, "materials");
  series_.load(in, "series");
  profiles_.load(in, "profiles");
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::SegregationObserver>(
      "segregation", "How particles part along an axis, by size, density, material or another class.",
      scree::SegregationObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("segregation", "1.0.0", &list)};
