#include "mass_flow_observer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/results/result_folder.hpp"

namespace scree {

MassFlowObserver::MassFlowObserver(const Options& options) : options_{options}, gate_{options} {
  if (options.has("fit_to") && options.number("fit_to") <= options.number("fit_from")) {
    throw options.error("fit_to", fmt::format("must be later than fit_from = {:g} s", options.number("fit_from")));
  }
}

std::vector<Parameter> MassFlowObserver::parameters() {
  return {Gate::parameter(),
          Frame::parameter(),
          Schedule::parameter(0.05, "over which rates are taken; rounded to whole steps"),
          Parameter::number("fit_from", "s", "begin of the window in which the rate is taken as constant")
              .at_least(0.0)
              .by_default(0.0),
          Parameter::number("fit_to", "s", "end of that window; the end of the run when left out").optional(),
          Parameter::integer("blocks", "parts of that window whose rates are taken as independent")
              .at_least(2)
              .by_default(10),
          Parameter::number("confidence", "1", "that the interval around the constant rate holds it")
              .above(0.0)
              .at_most(0.9999)
              .by_default(0.95),
          Parameter::boolean("crossings", "write a table of every passage").by_default(false)};
}

void MassFlowObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  frame_ = Frame{options_, services};
  schedule_ = Schedule{options_, services.time_step()};
  std::vector<std::string> endings{".csv", ".svg", ".png", "_total.svg", "_total.png"};
  if (options_.boolean("crossings")) endings.emplace_back("_crossings.csv");
  stem_ = Stem{"mass_flow", services, results, endings};
  if (options_.number("fit_from") >= services.end_time()) {
    services.log(
        fmt::format("mass_flow: fit_from = {:g} s is not before the end of the run at {:g} s: no constant rate",
                    options_.number("fit_from"), services.end_time()));
  }
  materials_ = GrainMaterials{services.materials()};
  passed_.assign(materials_.size(), {});
  net_before_.assign(materials_.size(), 0.0);
  std::vector<SeriesColumn> columns{{"time", "s"},           {"interval_begin", "s"}, {"number_forward", ""},
                                    {"number_backward", ""}, {"mass_forward", "kg"},  {"mass_backward", "kg"},
                                    {"mass_rate", "kg/s"}};
  for (const std::string& material : materials_.names()) {
    columns.push_back({"mass_" + lower_snake(material), "kg"});
    columns.push_back({"mass_rate_" + lower_snake(material), "kg/s"});
  }
  series_.open(stem_.table(), std::move(columns));
  lists_crossings_ = options_.boolean("crossings");
  crossings_.open(lists_crossings_ ? stem_.table("crossings") : std::filesystem::path{},
                  {{"time", "s"},
                   {"id"},
                   {"material", "", materials_.names()},
                   {"direction", "", {"backward", "forward"}},
                   {"x", "m"},
                   {"y", "m"},
                   {"z", "m"},
                   {"vx", "m/s"},
                   {"vy", "m/s"},
                   {"vz", "m/s"},
                   {"mass", "kg"},
                   {"diameter", "m"}});
}

void MassFlowObserver::observe(const Observation& now, Attributes&) {
  // Not always zero: a run may go on with an observer that the part before had not.
  if (std::isnan(interval_begin_)) interval_begin_ = now.time - now.dt;
  frame_.update(now.bodies);
  bodies_.walk(now.bodies, [&](BodyIndex i, Before& before, bool is_new) {
    const Vec3& place = now.bodies.position[i];
    // Fed at the begin of this step: it came from where its velocity says.
    if (is_new) materials_.see(now.bodies.material[i]);
    if (is_new) before.place = frame_.local(place - now.dt * now.bodies.velocity[i]);
    const Vec3 local = frame_.local(place);
    if (const auto passage = gate_.passage(before.place, local)) count(now, i, *passage);
    before.place = local;
  });
  if (schedule_.is_due(now.step)) end_interval(now.time);
}

void MassFlowObserver::count(const Observation& now, BodyIndex body, const Passage& passage) {
  Passed& passed = passed_[now.bodies.material[body]];
  const double mass = now.bodies.mass[body];
  (passage.forward ? passed.number_forward : passed.number_backward) += 1.0;
  (passage.forward ? passed.mass_forward : passed.mass_backward) += mass;
  if (!lists_crossings_) return;
  const Vec3& v = now.bodies.velocity[body];
  crossings_.add({now.time - (1.0 - passage.fraction) * now.dt, static_cast<double>(now.bodies.id[body]),
                  static_cast<double>(now.bodies.material[body]), passage.forward ? 1.0 : 0.0, passage.place.x,
                  passage.place.y, passage.place.z, v.x, v.y, v.z, mass, 2.0 * now.bodies.radius[body]});
}

MassFlowObserver::Passed& MassFlowObserver::Passed::operator+=(const Passed& other) {
  number_forward += other.number_forward;
  number_backward += other.number_backward;
  mass_forward += other.mass_forward;
  mass_backward += other.mass_backward;
  return *this;
}

MassFlowObserver::Passed MassFlowObserver::passed_by_all() const {
  Passed all;
  for (const Passed& passed : passed_) all += passed;
  return all;
}

void MassFlowObserver::end_interval(double time) {
  const Passed all = passed_by_all();
  const double net_before = std::accumulate(net_before_.begin(), net_before_.end(), 0.0);
  const double length = time - interval_begin_;
  std::vector<double> row{time,
                          interval_begin_,
                          all.number_forward,
                          all.number_backward,
                          all.mass_forward,
                          all.mass_backward,
                          (all.net_mass() - net_before) / length};
  for (std::size_t m = 0; m < passed_.size(); ++m) {
    const double net = passed_[m].net_mass();
    row.push_back(net);
    row.push_back((net - net_before_[m]) / length);
    net_before_[m] = net;
  }
  series_.add(row);
  interval_begin_ = time;
}

FlowRate MassFlowObserver::rate_of(const std::string& column) const {
  const std::vector<double> begin = series_.column("interval_begin"), end = series_.column("time");
  std::vector<double> amount = series_.column(column);
  for (std::size_t k = 0; k < amount.size(); ++k) amount[k] *= end[k] - begin[k];
  const double to = options_.has("fit_to") ? options_.number("fit_to") : std::numeric_limits<double>::infinity();
  return constant_rate(begin, end, amount, options_.number("fit_from"), to,
                       static_cast<std::size_t>(options_.integer("blocks")), options_.number("confidence"));
}

/// A sentence when fewer than two intervals lie within the window of the fit, which leaves its error open; else nothing.
std::string MassFlowObserver::why_no_rate() const {
  const std::size_t blocks = series_.rows() == 0 ? 2 : rate_of("mass_rate").blocks;
  if (blocks >= 2) return {};
  return fmt::format("no constant rate: {} interval from fit_from = {:g} s on lies within the window and the run",
                     blocks == 0 ? "no" : "a single", options_.number("fit_from"));
}

plot::Figure MassFlowObserver::rates() const {
  plot::Figure figure;
  figure.title = "Mass flow";
  figure.x = {"time [s]"};
  figure.y = {"mass rate [kg/s]"};
  const std::vector<double> begin = series_.column("interval_begin");
  std::vector<double> middle = series_.column("time");
  for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = 0.5 * (begin[k] + middle[k]);
  figure.series.push_back(
      {"over an interval", plot::SeriesStyle::line, std::move(middle), series_.column("mass_rate")});
  const FlowRate fit = rate_of("mass_rate");
  figure.note = why_no_rate();
  if (!std::isfinite(fit.rate.error)) return figure;
  figure.note =
      fmt::format("{:.4g} +- {:.2g} kg/s from {:g} s to {:g} s ({:g} % confidence, {} blocks)", fit.rate.value,
                  fit.rate.error, fit.from, fit.to, 100.0 * options_.number("confidence"), fit.blocks);
  figure.series.push_back(
      {"constant rate", plot::SeriesStyle::line, {fit.from, fit.to}, {fit.rate.value, fit.rate.value}});
  return figure;
}

plot::Figure MassFlowObserver::totals() const {
  plot::Figure figure;
  figure.title = "Mass that has passed";
  figure.x = {"time [s]"};
  figure.y = {"net mass [kg]"};
  const std::vector<double> time = series_.column("time");
  std::size_t moving = 0;
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    const bool any = passed_[m].number_forward + passed_[m].number_backward > 0.0;
    const std::string& name = materials_.names()[m];
    if (any && ++moving > 0) {
      figure.series.push_back({name, plot::SeriesStyle::line, time, series_.column("mass_" + lower_snake(name))});
    }
  }
  if (moving == 1) return figure;
  std::vector<double> net = series_.column("mass_forward");
  const std::vector<double> back = series_.column("mass_backward");
  for (std::size_t k = 0; k < net.size(); ++k) net[k] -= back[k];
  figure.series.insert(figure.series.begin(), {"all", plot::SeriesStyle::line, time, std::move(net)});
  return figure;
}

void MassFlowObserver::finish(const Observation& last) {
  if (series_.wants(last.time) && last.time > interval_begin_) end_interval(last.time);
  std::vector<std::string> of_walls;
  for (const char* prefix : {"mass_rate_", "mass_"}) {
    for (std::string& column : materials_.columns_of_walls(prefix)) of_walls.push_back(std::move(column));
  }
  series_.leave_out(of_walls);
  if (!stem_.writes() || series_.rows() == 0) return;
  plot::write_figure(rates(), stem_.figure());
  plot::write_figure(totals(), stem_.figure("total"));
}

std::vector<ReportTable> MassFlowObserver::report() const {
  ReportTable table;
  table.title = "Mass flow" + frame_.label();
  if (const std::string why = why_no_rate(); !why.empty()) table.title += "; " + why;
  table.header = {"material",    "forward",       "backward",   "forward [kg]", "backward [kg]",
                  "rate [kg/s]", "drift [kg/s2]", "window [s]", "blocks"};
  const auto plus_minus = [](const Estimate& estimate) {
    return std::isfinite(estimate.error) ? fmt::format("{:.4g} +- {:.2g}", estimate.value, estimate.error) : "none";
  };
  const auto add = [&](const std::string& name, const Passed& passed, const std::string& column) {
    const FlowRate fit = rate_of(column);
    table.rows.push_back({name, fmt::format("{}", passed.number_forward), fmt::format("{}", passed.number_backward),
                          fmt::format("{:.6g}", passed.mass_forward), fmt::format("{:.6g}", passed.mass_backward),
                          plus_minus(fit.rate), plus_minus(fit.drift),
                          fit.blocks > 0 ? fmt::format("{:g} to {:g}", fit.from, fit.to) : "none",
                          fmt::format("{}", fit.blocks)});
  };
  for (std::size_t m = 0; m < passed_.size(); ++m) {
    const Passed& passed = passed_[m];
    if (passed.number_forward + passed.number_backward > 0.0) {
      add(materials_.names()[m], passed, "mass_rate_" + lower_snake(materials_.names()[m]));
    }
  }
  add("all", passed_by_all(), "mass_rate");
  return {table};
}

void MassFlowObserver::save(StateWriter& out) const {
  bodies_.save(*out.group("bodies"));
  std::vector<double> passed;
  for (const Passed& p : passed_) {
    passed.insert(passed.end(), {p.number_forward, p.number_backward, p.mass_forward, p.mass_backward});
  }
  materials_.save(out, "materials");
  out.write("passed", passed);
  out.write("net_before", net_before_);
  out.write("interval_begin", interval_begin_);
  series_.save(out, "series");
  crossings_.save(out, "crossings");
}

void MassFlowObserver::load(const StateReader& in) {
  bodies_.load(*in.group("bodies"));
  materials_.load(in, "materials");
  const std::vector<double> passed = in.doubles("passed");
  net_before_ = in.doubles("net_before");
  if (passed.size() != 4 * passed_.size() || net_before_.size() != passed_.size()) {
    throw Error{ErrorKind::io,
                "the mass flow in the checkpoint is of a scene with other materials; resume the scene it is of."};
  }
  for (std::size_t m = 0; m < passed_.size(); ++m) {
    passed_[m] = {passed[4 * m], passed[4 * m + 1], passed[4 * m + 2], passed[4 * m + 3]};
  }
  interval_begin_ = in.number("interval_begin");
  series_.load(in, "series");
  crossings_.load(in, "crossings");
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::MassFlowObserver>(
      "mass_flow", "What passes through a plane, disc or rectangle, and at what rate.",
      scree::MassFlowObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("mass_flow", "1.0.0", &list)};
