#include "bins_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

Direction direction_of(const std::string& word) {
  if (word == "forward") return Direction::forward;
  return word == "backward" ? Direction::backward : Direction::both;
}

Collector collector_of(const Options& options) {
  const Vec3 u = options.vector("u"), v = options.vector("v");
  if (norm(cross(u, v)) <= 1e-12 * norm(u) * norm(v)) {
    throw options.error("v", "and 'u' are parallel or zero; they must span the collecting rectangle");
  }
  return {options.vector("origin"),
          u,
          v,
          static_cast<int>(options.integer("u_bins")),
          static_cast<int>(options.integer("v_bins")),
          direction_of(options.text("direction"))};
}

std::vector<Target> targets_of(const Options& options) {
  std::vector<Target> targets;
  for (const Options& table : options.tables("target")) {
    targets.push_back(
        {table.text("name"), table.texts("materials"), table.text("attribute"), table.number("at_least")});
    if (targets.back().materials.empty() && targets.back().attribute.empty()) {
      throw table.error("a target needs `materials`, an `attribute`, or both");
    }
  }
  return targets;
}

}  // namespace

BinsObserver::BinsObserver(const Options& options)
    : options_{options},
      collector_{collector_of(options)},
      targets_{targets_of(options)},
      series_interval_{options.number("series_interval")} {}

std::vector<Parameter> BinsObserver::parameters() {
  std::vector<Parameter> target{
      Parameter::text("name", "of the target, for tables and the figure"),
      Parameter::texts("materials", "materials that belong to it; all when left out")
          .by_default(std::vector<std::string>{}),
      Parameter::text("attribute", "a body attribute that decides as well").by_default(""),
      Parameter::number("at_least", "1", "smallest value of the attribute that belongs").by_default(0.5)};
  return {
      Parameter::vector("origin", "m", "a corner of the collecting rectangle"),
      Parameter::vector("u", "m", "edge of the rectangle along which the bins and the splitters lie"),
      Parameter::vector("v", "m", "the other edge"),
      Parameter::integer("u_bins", "number of bins along u").at_least(1).at_most(10000),
      Parameter::integer("v_bins", "number of bins along v").at_least(1).at_most(1000).by_default(1),
      Parameter::choice("direction", {"forward", "backward", "both"}, "crossings that count; forward is along u x v")
          .by_default("both"),
      Parameter::number("series_interval", "s", "of the time series; rounded to whole steps")
          .above(0.0)
          .by_default(0.05),
      Parameter::numbers("splitters", "m", "splitter positions, as distances from the origin along u, ascending")
          .by_default(std::vector<double>{}),
      Parameter::texts("products", "names of the products between the splitters, one more than splitters")
          .by_default(std::vector<std::string>{}),
      Parameter::texts("product_targets", "the target or material that each product is for, \"\" for none")
          .by_default(std::vector<std::string>{}),
      Parameter::choice("objective", {"recovery_times_grade", "separation_efficiency"},
                        "what the best splitters maximise")
          .by_default("recovery_times_grade"),
      Parameter::tables("target", std::move(target), "bodies whose grade and recovery are wanted").optional(),
  };
}

void BinsObserver::setup(SceneServices& services, const std::filesystem::path& results) {
  name_ = lower_snake(services.part_name().empty() ? "bins" : services.part_name());
  claim_results(services, "bins_" + name_, {"_series.csv", ".csv", "_ledger.csv", ".svg", ".png"});
  results_ = results;
  setup_categories(services);
  setup_plan();
  column_ = services.provide_attribute(
      {"bin_" + name_, "1", "bin: 0 not yet, k + 1 in bin k, -1 crossed the plane outside of the rectangle", 0.0, {}});
  steps_between_ = static_cast<std::uint64_t>(std::max(1.0, std::round(series_interval_ / services.time_step())));
  const std::size_t count = categories_.names.size();
  tracker_ = std::make_unique<Tracker>(
      count, [this](const BodyView& bodies, BodyIndex body) { return categorise(bodies, body); },
      [this](std::uint32_t material) { return categorise_removed(material); });
  bins_ = TallyTable{count, collector_.bins()};
  products_ = TallyTable{count, plan_.names.size()};
  series_ = std::make_unique<SeriesLog>(count, collector_.bins());
  series_->open(results.empty() ? results : results / ("bins_" + name_ + "_series.csv"), categories_.names);
}

void BinsObserver::setup_categories(SceneServices& services) {
  categories_.names = {"all"};
  for (const std::string& material : services.materials().names()) categories_.names.push_back(material);
  categories_.first_target = categories_.names.size();
  const std::size_t count = categories_.first_target + targets_.size();
  if (count > kMostCategories) {
    throw options_.error(fmt::format("{} materials and targets are more than the {} that bins can tell apart",
                                     count - 1, kMostCategories - 1));
  }
  std::erase_if(targets_, [&](const Target& target) {
    const std::size_t material = categories_.find(target.name);
    const bool alias = material < categories_.names.size() && target.attribute.empty() &&
                       target.materials == std::vector<std::string>{target.name};
    if (alias) categories_.aliased.push_back(material);
    return alias;
  });
  for (Target& target : targets_) {
    if (categories_.find(target.name) < categories_.names.size() || target.name == categories_.names[0]) {
      throw options_.error("target",
                           "calls one '" + target.name +
                               "', which already names a material, another target, or all bodies; names must differ");
    }
    categories_.names.push_back(target.name);
    for (const std::string& material : target.materials) {
      target.material_mask |= CategoryMask{1} << services.material(material);
    }
    if (target.materials.empty()) target.material_mask = ~CategoryMask{0};
    if (!target.attribute.empty()) {
      target.column = services.require_attribute(target.attribute, "1", "decides what belongs to " + target.name);
    }
  }
}

void BinsObserver::setup_plan() {
  plan_.splitters = options_.numbers("splitters");
  plan_.names = options_.texts("products");
  plan_.objective = options_.text("objective") == "separation_efficiency" ? Objective::separation_efficiency
                                                                          : Objective::recovery_times_grade;
  const std::vector<double>& s = plan_.splitters;
  const bool ascending = std::adjacent_find(s.begin(), s.end(), std::greater_equal<>{}) == s.end();
  const double length = norm(collector_.u());
  if (!ascending || (!s.empty() && (s.front() <= 0.0 || s.back() >= length))) {
    throw options_.error("splitters", fmt::format("must ascend and lie between 0 and {:g} m, the length of u", length));
  }
  if (plan_.names.empty()) {
    for (std::size_t p = 0; p <= s.size(); ++p) plan_.names.push_back(fmt::format("product {}", p + 1));
  }
  if (plan_.names.size() != s.size() + 1) {
    throw options_.error("products", fmt::format("has {} names, but {} splitters make {} products", plan_.names.size(),
                                                 s.size(), s.size() + 1));
  }
  const std::vector<std::string>& wanted = options_.texts("product_targets");
  if (!wanted.empty() && wanted.size() != plan_.names.size()) {
    throw options_.error("product_targets",
                         fmt::format("has {} targets, but there are {} products", wanted.size(), plan_.names.size()));
  }
  for (const std::string& name : wanted) {
    const std::size_t category = name.empty() ? kNoTarget : categories_.find(name);
    if (category == categories_.names.size()) {
      throw options_.error("product_targets",
                           "names '" + name + "', which is neither a material nor a target of these bins");
    }
    plan_.wanted.push_back(category);
  }
}

CategoryMask BinsObserver::categorise_removed(std::uint32_t material) const {
  CategoryMask mask = 1 | CategoryMask{2} << material;
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    const bool belongs = targets_[t].attribute.empty() && (targets_[t].material_mask >> material & 1) != 0;
    if (belongs) mask |= CategoryMask{1} << (categories_.first_target + t);
  }
  return mask;
}

CategoryMask BinsObserver::categorise(const BodyView& bodies, BodyIndex body) const {
  CategoryMask mask = categorise_removed(bodies.material[body]);
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    const Target& target = targets_[t];
    if (target.attribute.empty() || (target.material_mask >> bodies.material[body] & 1) == 0) continue;
    if (bodies.attribute(target.column)[body] >= target.at_least) {
      mask |= CategoryMask{1} << (categories_.first_target + t);
    }
  }
  return mask;
}

void BinsObserver::look(const Observation& now) {
  SCREE_REQUIRE(tracker_ != nullptr, "bins: setup() comes before the first look");
  binned_.clear();
  tracker_->look(now, collector_, binned_);
  for (const Binned& body : binned_) {
    bins_.add(body.mask, body.bin, body.mass);
    products_.add(body.mask, plan_.product(body.a * norm(collector_.u())), body.mass);
    series_->add(body.mask, body.bin, body.mass);
  }
  time_ = now.time;
}

void BinsObserver::observe(const Observation& now, Attributes& attributes) {
  look(now);
  tracker_->write_column(now.bodies, attributes.column(column_));
  if (now.step % steps_between_ == 0) series_->end_interval(now.time);
}

void BinsObserver::finish(const Observation& last) {
  Observation end = last;
  end.dt = 0.0;  // nothing moved since the last step: a body fed since then stands where it was born
  look(end);
  series_->end_interval(last.time);
  if (results_.empty()) return;
  write_bins_table(result(), results_ / ("bins_" + name_ + ".csv"));
  write_ledger(result(), results_ / ("bins_" + name_ + "_ledger.csv"));
  plot::write_figure(bins_figure(result()), results_ / ("bins_" + name_));
}

BinsResult BinsObserver::result() const {
  return {name_, categories_, collector_, *tracker_, plan_, bins_, products_, time_};
}

std::vector<ReportTable> BinsObserver::report() const { return bins_report(result()); }

void BinsObserver::save(StateWriter& out) const {
  tracker_->save(*out.group("bodies"));
  bins_.save(out, "bins");
  products_.save(out, "products");
  series_->save(*out.group("series"));
}

void BinsObserver::load(const StateReader& in) {
  tracker_->load(*in.group("bodies"));
  bins_.load(in, "bins");
  products_.load(in, "products");
  series_->load(*in.group("series"));
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::BinsObserver>(
      "bins", "Counts what falls through a rectangle into bins, and accounts for everything fed.",
      scree::BinsObserver::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("bins", "1.0.0", &list)};
