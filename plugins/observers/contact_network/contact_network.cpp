#include "contact_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "plot/figure.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

// Columns of the table.
constexpr std::size_t kTime = 0, kCoordination = 3, kHeld = 4, kSliding = 8, kAnisotropy = 9, kColumns = 16;

std::vector<SeriesColumn> columns() {
  return {{"time", "s"},
          {"grains"},
          {"links"},
          {"coordination"},
          {"coordination_without_rattlers"},
          {"rattlers"},
          {"mean_normal_force", "N"},
          {"largest_normal_force", "N"},
          {"sliding_share"},
          {"anisotropy"},
          {"fabric_xx"},
          {"fabric_yy"},
          {"fabric_zz"},
          {"fabric_yz"},
          {"fabric_xz"},
          {"fabric_xy"}};
}

}  // namespace

void ForceHistogram::add(const Network& network) {
  double sum = 0.0;
  std::size_t links = 0;
  for (const Link& link : network.links) {
    if (!counts(network, link)) continue;
    sum += link.normal_force;
    ++links;
  }
  if (!(sum > 0.0)) return;
  const double mean = sum / static_cast<double>(links);
  for (const Link& link : network.links) {
    if (!counts(network, link)) continue;
    const double bin = std::max(0.0, link.normal_force / mean * (kBins / kTop));
    ++counts_[std::min(kBins - 1, static_cast<std::size_t>(bin))];
  }
}

std::uint64_t ForceHistogram::total() const {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

void ForceHistogram::save(StateWriter& out) const { out.write("counts", std::span<const std::uint64_t>{counts_}); }

void ForceHistogram::load(const StateReader& in) { counts_ = in.integers("counts"); }

double ForceHistogram::density(std::size_t bin) const {
  const double all = static_cast<double>(std::max<std::uint64_t>(1, total()));
  return static_cast<double>(counts_[bin]) / (all * (kTop / kBins));
}

ContactNetwork::ContactNetwork(const Options& options)
    : options_{options},
      least_{static_cast<std::uint32_t>(options.integer("least_contacts"))},
      from_{options.number("from")} {}

std::vector<Parameter> ContactNetwork::parameters() {
  return {
      Parameter::number("interval", "s", "simulated time between looks; 0: every step").at_least(0.0).by_default(0.01),
      Parameter::number("file_interval", "s", "simulated time between files of the network; none when left out")
          .above(0.0)
          .optional(),
      Parameter::number("from", "s", "distributions hold what is seen from this time on").at_least(0.0).by_default(0.0),
      Region::parameter(),
      Parameter::integer("least_contacts", "grains with fewer are rattlers").at_least(1).by_default(4)};
}

void ContactNetwork::setup(SceneServices& services, const std::filesystem::path& results) {
  materials_ = &services.materials();
  end_time_ = services.end_time();
  region_ = Region{options_, services};
  row_every_ = steps_between(options_.number("interval"), services.time_step());
  if (options_.has("file_interval")) {
    file_every_ = steps_between(options_.number("file_interval"), services.time_step());
  }
  stem_ = result_stem("contact_network", "contact_network", services.part_name());
  claim_results(services, stem_,
                {".csv", "_coordination.csv", "_forces.csv", ".svg", ".png", "_forces.svg", "_forces.png"});
  if (file_every_ > 0) claim_results(services, stem_, {"_*.vtp", ".pvd"});
  results_ = results;
  table_ = SeriesTable{columns()};
  if (!results.empty()) table_.open(results / (stem_ + ".csv"));
}

void ContactNetwork::observe(const Observation& now, Attributes&) {
  const bool row = now.step % row_every_ == 0;
  const bool file = file_every_ > 0 && now.step % file_every_ == 0 && !results_.empty();
  const bool last = now.time > end_time_ - 0.5 * now.dt;
  if (!row && !file && !last) return;
  region_.update(now.bodies);
  build_network(now.bodies, now.contacts, now.dt, *materials_, region_, network_);
  network_time_ = now.time;
  if (row) add_row(now.time);
  if (file) write_file(now);
}

void ContactNetwork::add_row(double time) {
  const Coordination grains = coordination(network_, least_);
  const Fabric normals = fabric(network_);
  double sum = 0.0, largest = 0.0;
  std::size_t links = 0, sliding = 0;
  for (const Link& link : network_.links) {
    if (!counts(network_, link)) continue;
    ++links;
    sum += link.normal_force;
    largest = std::max(largest, link.normal_force);
    sliding += link.slides ? 1 : 0;
  }
  const double per_link = links > 0 ? 1.0 / static_cast<double>(links) : 0.0;
  const Mat3& f = normals.tensor;
  table_.add(std::array<double, kColumns>{
      time, static_cast<double>(grains.grains), static_cast<double>(links), grains.mean, grains.mean_without_rattlers,
      static_cast<double>(grains.rattlers), per_link * sum, largest, per_link * static_cast<double>(sliding),
      normals.anisotropy, f.row0.x, f.row1.y, f.row2.z, f.row1.z, f.row0.z, f.row0.y});
  if (time < from_) return;
  forces_.add(network_);
  if (degrees_.size() < grains.distribution.size()) degrees_.resize(grains.distribution.size(), 0);
  for (std::size_t k = 0; k < grains.distribution.size(); ++k) degrees_[k] += grains.distribution[k];
}

// When finish() is called, sinks may have taken bodies that the contacts name: the network is that of the last step's look.
void ContactNetwork::finish(const Observation& last) {
  const bool has_row = table_.rows() > 0 && table_.value(table_.rows() - 1, kTime) == last.time;
  if (network_time_ == last.time && !has_row) add_row(last.time);
  table_.close();
  if (results_.empty() || table_.rows() == 0) return;
  write_histograms();
  write_figures();
}

void ContactNetwork::write_histograms() const {
  CsvWriter coordinations{results_ / (stem_ + "_coordination.csv"), {{"links", ""}, {"grains", ""}, {"share", ""}}};
  const auto all = static_cast<double>(std::accumulate(degrees_.begin(), degrees_.end(), std::uint64_t{0}));
  for (std::size_t k = 0; k < degrees_.size(); ++k) {
    coordinations.cell(std::uint64_t{k}).cell(degrees_[k]).cell(static_cast<double>(degrees_[k]) / all).end_row();
  }
  coordinations.close();
  CsvWriter forces{results_ / (stem_ + "_forces.csv"),
                   {{"from_over_mean", ""}, {"to_over_mean", ""}, {"links", ""}, {"density", ""}}};
  for (std::size_t k = 0; k < ForceHistogram::kBins; ++k) {
    forces.cell(ForceHistogram::edge(k)).cell(ForceHistogram::edge(k + 1)).cell(forces_.count(k));
    forces.cell(forces_.density(k)).end_row();
  }
  forces.close();
}

void ContactNetwork::write_figures() const {
  plot::Figure links;
  links.title = "Contacts of grains";
  links.x = {"time [s]"};
  links.y = {"mean number, share, anisotropy [1]"};
  const std::vector<double> time = table_.column(kTime);
  for (const auto& [column, label] :
       {std::pair{kCoordination, "coordination"}, std::pair{kHeld, "coordination without rattlers"},
        std::pair{kSliding, "share that slides"}, std::pair{kAnisotropy, "anisotropy of the fabric"}}) {
    links.series.push_back({label, plot::SeriesStyle::line, time, table_.column(column)});
  }
  plot::write_figure(links, results_ / stem_);
  if (forces_.total() == 0) return;
  plot::Figure forces;
  forces.title = "Distribution of normal forces";
  forces.note = fmt::format("{} links; the last bin holds all that are stronger", forces_.total());
  forces.x = {"normal force over its mean [1]"};
  forces.y = {"probability density [1]", plot::Scale::logarithmic};
  plot::Series bins{"links", plot::SeriesStyle::points, {}, {}};
  for (std::size_t k = 0; k < ForceHistogram::kBins; ++k) {
    if (forces_.count(k) == 0) continue;
    bins.x.push_back(0.5 * (ForceHistogram::edge(k) + ForceHistogram::edge(k + 1)));
    bins.y.push_back(forces_.density(k));
  }
  forces.series.push_back(std::move(bins));
  plot::write_figure(forces, results_ / (stem_ + "_forces"));
}

std::vector<ReportTable> ContactNetwork::report() const {
  ReportTable table;
  table.title = stem_ + ": contacts of grains at the last look";
  table.header = {"grains",        "links",     "coordination", "without rattlers", "rattlers", "mean normal force [N]",
                  "sliding share", "anisotropy"};
  if (table_.rows() == 0) return {table};
  std::vector<std::string> row;
  for (const std::size_t column :
       {std::size_t{1}, std::size_t{2}, kCoordination, kHeld, std::size_t{5}, std::size_t{6}, kSliding, kAnisotropy}) {
    row.push_back(fmt::format("{:.6g}", table_.value(table_.rows() - 1, column)));
  }
  table.rows.push_back(std::move(row));
  return {table};
}

void ContactNetwork::save(StateWriter& out) const {
  table_.save(*out.group("table"));
  series_.save(out, "frames");
  forces_.save(*out.group("forces"));
  out.write("degrees", std::span<const std::uint64_t>{degrees_});
}

void ContactNetwork::load(const StateReader& in) {
  table_.load(*in.group("table"));
  series_.load(in, "frames", results_);
  forces_.load(*in.group("forces"));
  degrees_ = in.integers("degrees");
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::ContactNetwork>(
      "contact_network", "Coordination, force network and fabric of the contacts between grains.",
      scree::ContactNetwork::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("contact_network", "1.0.0", &list)};
