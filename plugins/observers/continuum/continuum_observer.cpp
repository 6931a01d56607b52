#include "continuum_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "field_values.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/results/result_folder.hpp"
#include "vtp/image_data.hpp"

namespace scree {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Kernel kernel_of(const Options& options, const CellGrid& grid) {
  const double width = options.number("width");
  const double widest = std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z});
  if (width < 0.5 * widest) {
    throw options.error("width",
                        fmt::format("is below half a cell ({:g} m): grains would fall between the centres of the "
                                    "cells; take at least {:g} m, or smaller cells",
                                    widest, 0.5 * widest));
  }
  return {options.text("kernel") == "gaussian" ? KernelKind::gaussian : KernelKind::lucy, width};
}

int axis_of(const std::string& word) { return word == "x" ? 0 : (word == "y" ? 1 : 2); }

}  // namespace

ContinuumObserver::ContinuumObserver(const Options& options)
    : options_{options}, contact_stress_{options.boolean("contact_stress")} {}

std::vector<Parameter> ContinuumObserver::parameters() {
  return {
      CellGrid::parameter(),
      Parameter::choice("kernel", {"lucy", "gaussian"}, "shape of the coarse-graining kernel").by_default("lucy"),
      Parameter::number("width", "m", "of the kernel: half the range of Lucy's, the standard deviation of the Gaussian")
          .above(0.0),
      Schedule::parameter(0.01, "simulated time between two looks of an average; 0 for every step"),
      Parameter::number("from", "s", "when averaging begins").at_least(0.0).by_default(0.0),
      Parameter::number("window", "s", "averaged over; until the end of the run when left out").above(0.0).optional(),
      Parameter::boolean("remove_gradient", "take the gradient of the mean velocity out of the granular temperature")
          .by_default(true),
      Parameter::number("min_samples", "1", "temperature is left out where fewer grains count, summed over looks")
          .at_least(0.0)
          .by_default(10.0),
      Parameter::boolean("contact_stress", "stress that contacts carry").by_default(false),
      Parameter::choice("profile_axis", {"x", "y", "z"}, "axis of the table of means over layers").by_default("z"),
      Parameter::choice("slice_normal", {"x", "y", "z"}, "of the slice that is drawn").by_default("y"),
      Parameter::number("slice_place", "m", "where the slice lies; the middle of the grid when left out").optional(),
      Parameter::choice("slice_field", slice_field_names(), "what the slice shows").by_default("solid_fraction")};
}

void ContinuumObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  if (!options_.table("grid").text("frame").empty()) {
    throw options_.table("grid").error("frame", "is not supported here: fields are those of the world; leave it out");
  }
  executor_ = &services.executor();
  results_ = results;
  schedule_ = Schedule{options_, services.time_step()};
  stem_ = Stem{"continuum", services, results, {"_*.vti", ".pvd", "_profile.csv", "_slice.svg", "_slice.png"}};
  grid_ = CellGrid{options_, services};
  if (options_.has("slice_place")) {
    const int normal = axis_of(options_.text("slice_normal"));
    const double place = options_.number("slice_place"), from = grid_.box().lower[normal],
                 to = grid_.box().upper[normal];
    if (place < from || place > to) {
      throw options_.error(
          "slice_place", fmt::format("lies outside of the grid, which reaches from {:g} m to {:g} m along {}", from, to,
                                     options_.text("slice_normal")));
    }
  }
  field_ = std::make_unique<CoarseField>(grid_, kernel_of(options_, grid_));
  if (options_.has("window")) steps_of_window_ = steps_between(options_.number("window"), services.time_step());
  window_begin_ = kNone;
  std::vector<SeriesColumn> columns{{"time", "s"},
                                    {"window_begin", "s"},
                                    {options_.text("profile_axis"), "m"},
                                    {"solid_fraction"},
                                    {"density", "kg/m3"},
                                    {"velocity_x", "m/s"},
                                    {"velocity_y", "m/s"},
                                    {"velocity_z", "m/s"},
                                    {"granular_temperature", "m2/s2"},
                                    {"kinetic_pressure", "Pa"}};
  if (contact_stress_) {
    for (const char* entry : {"xx", "yy", "zz", "xy", "xz", "yz"})
      columns.push_back({std::string{"contact_stress_"} + entry, "Pa"});
  }
  profiles_.open(stem_.table("profile"), std::move(columns));
}

void ContinuumObserver::observe(const Observation& now, Attributes&) {
  constexpr double kRounding = 1e-9;  // of a step
  const double since = (now.time - options_.number("from")) / now.dt;
  if (since < 1.0 - kRounding) return;
  // Later than asked for when a run goes on with an observer that the part before had not.
  if (std::isnan(window_begin_)) window_begin_ = now.time - now.dt;
  if (schedule_.is_due(now.step)) look(now);
  const auto step = static_cast<std::uint64_t>(std::llround(since));
  if (steps_of_window_ > 0 && step % steps_of_window_ == 0) end_window(now);
}

void ContinuumObserver::look(const Observation& now) {
  grains_.clear();
  for (std::size_t i = 0; i < now.bodies.size(); ++i) {
    if (now.bodies.motion[i] != Motion::dynamic) continue;
    const double r = now.bodies.radius[i];
    grains_.push_back(
        {now.bodies.position[i], now.bodies.velocity[i], now.bodies.mass[i], 4.0 / 3.0 * std::numbers::pi * r * r * r});
  }
  branches_.clear();
  if (contact_stress_) append_branches(now, branches_);
  field_->add(grains_, branches_, *executor_);
}

std::vector<CoarseCell> ContinuumObserver::cells() const {
  std::vector<CoarseCell> cells;
  for (std::size_t k = 0; k < field_->size(); ++k) {
    cells.push_back(field_->cell(k, options_.boolean("remove_gradient"), options_.number("min_samples")));
  }
  return cells;
}

void ContinuumObserver::end_window(const Observation& now) {
  if (field_->looks() == 0.0) return;
  const std::vector<CoarseCell> fields = cells();
  add_profile(fields, now.time);
  if (stem_.writes()) {
    write_fields(fields, now);
    plot::write_heat_map(slice(fields, now.time), stem_.figure("slice"));
  }
  field_->clear();
  window_begin_ = now.time;
}

void ContinuumObserver::write_fields(const std::vector<CoarseCell>& cells, const Observation& now) {
  ImageData image{now.time, grid_.box().lower, grid_.spacing(), grid_.count(), field_arrays(cells, contact_stress_)};
  const std::string file = fmt::format("{}_{:08}.vti", stem_.figure().filename().string(), now.step);
  write_vti(image, results_ / file);
  files_.add(now.time, 0, file);
  files_.write(stem_.figure().string() + ".pvd");
}

void ContinuumObserver::add_profile(const std::vector<CoarseCell>& cells, double time) {
  const int axis = axis_of(options_.text("profile_axis"));
  const std::size_t layers = grid_.count()[static_cast<std::size_t>(axis)];
  std::vector<LayerMean> means(layers);
  for (std::size_t k = 0; k < cells.size(); ++k)
    means[cell_places(grid_, k)[static_cast<std::size_t>(axis)]].add(cells[k]);
  for (std::size_t l = 0; l < layers; ++l) {
    const LayerMean& mean = means[l];
    const Vec3 u = mean.velocity();
    std::vector<double> row{time,
                            window_begin_,
                            grid_.box().lower[axis] + (static_cast<double>(l) + 0.5) * grid_.spacing()[axis],
                            mean.solid_fraction(),
                            mean.density(),
                            u.x,
                            u.y,
                            u.z,
                            mean.temperature(),
                            mean.kinetic_pressure()};
    const Mat3 s = mean.contact_stress();
    if (contact_stress_) row.insert(row.end(), {s.row0.x, s.row1.y, s.row2.z, s.row0.y, s.row0.z, s.row1.z});
    profiles_.add(row);
  }
}

plot::HeatMap ContinuumObserver::slice(const std::vector<CoarseCell>& cells, double time) const {
  const int normal = axis_of(options_.text("slice_normal"));
  const int across = normal == 0 ? 1 : 0, up = normal == 2 ? 1 : 2;
  const Aabb& box = grid_.box();
  const double middle = 0.5 * (box.lower[normal] + box.upper[normal]);
  const double place = options_.has("slice_place") ? options_.number("slice_place") : middle;
  const std::size_t layers = grid_.count()[static_cast<std::size_t>(normal)];
  const double along = std::max(0.0, (place - box.lower[normal]) / grid_.spacing()[normal]);
  const std::size_t layer = std::min(static_cast<std::size_t>(along), layers - 1);
  const SliceField& field = slice_field(options_.text("slice_field"));
  plot::HeatMap map;
  map.title = fmt::format("{} at {} = {:.4g} m", field.title, "xyz"[normal],
                          box.lower[normal] + (static_cast<double>(layer) + 0.5) * grid_.spacing()[normal]);
  map.note = fmt::format("mean from {:g} s to {:g} s, {} looks; {} kernel, width {:g} m", window_begin_, time,
                         field_->looks(), options_.text("kernel"), options_.number("width"));
  map.x_label = fmt::format("{} [m]", "xyz"[across]);
  map.y_label = fmt::format("{} [m]", "xyz"[up]);
  map.x_range = {box.lower[across], box.upper[across]};
  map.y_range = {box.lower[up], box.upper[up]};
  map.columns = grid_.count()[static_cast<std::size_t>(across)];
  map.value_label = fmt::format("{} [{}]", field.label, field.unit);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    // Cells go x fastest, then y, then z: so do the rows of the slice.
    if (cell_places(grid_, k)[static_cast<std::size_t>(normal)] == layer) {
      map.values.push_back(cells[k].density > 0.0 ? field.value(cells[k]) : kNone);
    }
  }
  return map;
}

void ContinuumObserver::finish(const Observation& last) { end_window(last); }

std::vector<ReportTable> ContinuumObserver::report() const {
  ReportTable table;
  table.title = "Continuum fields, means over the layers of the last window";
  table.header = {"field", "smallest", "largest"};
  if (profiles_.rows() == 0) return {};
  const std::array<std::pair<const char*, const char*>, 4> rows{
      {{"solid_fraction", "solid fraction [1]"},
       {"density", "density [kg/m3]"},
       {"granular_temperature", "granular temperature [m2/s2]"},
       {"kinetic_pressure", "kinetic pressure [Pa]"}}};
  for (const auto& [name, label] : rows) {
    std::vector<double> values = profiles_.last_of(name);
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    if (values.empty()) continue;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    table.rows.push_back({label, fmt::format("{:.4g}", *low), fmt::format("{:.4g}", *high)});
  }
  return {table};
}

void ContinuumObserver::save(StateWriter& out) const {
  field_->save(*out.group("field"));
  out.write("window_begin", window_begin_);
  profiles_.save(out, "profiles");
  files_.save(out, "files");
}

void ContinuumObserver::load(const StateReader& in) {
  field_->load(*in.group("field"));
  window_begin_ = in.number("window_begin");
  profiles_.load(in, "profiles");
  files_.load(in, "files", results_);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::ContinuumObserver>(
      "continuum", "Solid fraction, density, velocity, granular temperature and stress on a grid (coarse graining).",
      scree::ContinuumObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("continuum", "1.0.0", &list)};
