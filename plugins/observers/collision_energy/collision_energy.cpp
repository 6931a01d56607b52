#include "collision_energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/figure.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// The kinds of spectrum with their names in tables.
struct Kind {
  const char* name;
  LogHistogram PairSpectra::*bins;
};
/// Those that a figure can tell apart, in the order of the table.
std::vector<const PairSpectra*> most_frequent(const std::vector<PairSpectra>& pairs) {
  constexpr std::size_t kMost = 6;
  std::vector<const PairSpectra*> shown;
  for (const PairSpectra& pair : pairs) {
    if (pair.normal.total_count() > 0) shown.push_back(&pair);
  }
  if (shown.size() <= kMost) return shown;
  std::ranges::stable_sort(shown, std::greater{}, [](const PairSpectra* p) { return p->normal.total_count(); });
  shown.resize(kMost);
  std::ranges::sort(shown);  // they lie in one array
  return shown;
}

constexpr std::array kKinds{Kind{"normal", &PairSpectra::normal}, Kind{"tangential", &PairSpectra::tangential},
                            Kind{"dissipated", &PairSpectra::dissipated}};

}  // namespace

CollisionEnergy::CollisionEnergy(const Options& options)
    : options_{options}, min_speed_{options.number("min_speed")}, from_{options.number("from")} {
  if (options.number("upper") <= options.number("lower")) throw options.error("upper", "must be greater than 'lower'");
}

std::vector<Parameter> CollisionEnergy::parameters() {
  return {
      Parameter::number("interval", "s", "of the rates over time; rounded to whole steps").above(0.0).by_default(0.05),
      Parameter::number("from", "s", "spectra hold collisions that end from this time on")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("lower", "J", "smallest energy that has a bin of its own").above(0.0).by_default(1e-9),
      Parameter::number("upper", "J", "greatest").above(0.0).by_default(1.0),
      Parameter::integer("bins_per_decade", "to a factor of ten of energy").at_least(1).at_most(100).by_default(5),
      Parameter::number("min_speed", "m/s", "contacts that closed slower are no collisions")
          .at_least(0.0)
          .by_default(0.02)};
}

void CollisionEnergy::setup(SceneServices& services, const std::filesystem::path& results) {
  spectra_ = Spectra{services.materials(), SpectrumRange{options_.number("lower"), options_.number("upper"),
                                                         static_cast<int>(options_.integer("bins_per_decade"))}};
  every_ = steps_between(options_.number("interval"), services.time_step());
  stem_ = result_stem("collision_energy", "collision_energy", services.part_name());
  claim_results(services, stem_, {"_series.csv", ".csv", ".svg", ".png"});
  results_ = results;
  series_ = SeriesTable{{{"time", "s"},
                         {"collisions"},
                         {"collision_rate", "1/s"},
                         {"normal_energy_rate", "W"},
                         {"tangential_energy_rate", "W"},
                         {"dissipated_rate", "W"}}};
  if (!results.empty()) series_.open(results / (stem_ + "_series.csv"));
}

void CollisionEnergy::observe(const Observation& now, Attributes&) {
  end_interval(row_due_);
  ended_.clear();
  book_.look(now.bodies, now.contacts, ended_);
  if (now.time >= from_) {
    observed_ += now.dt;
    for (const Collision& collision : ended_) count(collision);
  }
  if (now.step % every_ == 0) row_due_ = now.time;
}

void CollisionEnergy::count(const Collision& collision) {
  if (!(collision.speed >= min_speed_) || collision.mass == 0.0) {
    slow_ += 1.0;
    return;
  }
  spectra_.add(collision);
  sums_.collisions += 1.0;
  sums_.normal += collision.normal_energy;
  sums_.tangential += collision.tangential_energy;
  sums_.dissipated += collision.dissipated;
}

void CollisionEnergy::end_interval(double time) {
  if (!(time > began_)) return;
  const double rate = 1.0 / (time - began_);
  series_.add(std::array{time, sums_.collisions, rate * sums_.collisions, rate * sums_.normal, rate * sums_.tangential,
                         rate * sums_.dissipated});
  sums_ = {};
  began_ = time;
}

// What is still in contact at the end has collided too.
void CollisionEnergy::finish(const Observation& last) {
  if (last.time >= from_) {
    for (const Collision& collision : book_.open_collisions()) count(collision);
  }
  end_interval(last.time);
  series_.close();
  if (results_.empty()) return;
  write_spectra();
  write_figure();
}

void CollisionEnergy::write_spectra() const {
  CsvWriter table{
      results_ / (stem_ + ".csv"),
      {{"pair", ""}, {"energy", ""}, {"from", "J"}, {"to", "J"}, {"collisions", ""}, {"rate", "1/s"}, {"sum", "J"}}};
  const double per_second = observed_ > 0.0 ? 1.0 / observed_ : 0.0;
  for (const PairSpectra& pair : spectra_.pairs()) {
    for (const Kind& kind : kKinds) {
      const LogHistogram& bins = pair.*kind.bins;
      for (std::size_t k = 0; bins.total_count() > 0 && k < bins.bins(); ++k) {
        table.cell(std::string_view{pair.name}).cell(std::string_view{kind.name});
        table.cell(bins.edges()[k]).cell(bins.edges()[k + 1]).cell(bins.count(k));
        table.cell(per_second * static_cast<double>(bins.count(k))).cell(bins.weight(k)).end_row();
      }
    }
  }
  table.close();
}

void CollisionEnergy::write_figure() const {
  plot::Figure figure;
  figure.title = "Collision energies";
  figure.note = fmt::format("{:.4g} s; n: energy along the normal at impact, d: dissipated", observed_);
  figure.x = {"energy of a collision [J]", plot::Scale::logarithmic};
  figure.y = {"collisions per second and bin [1/s]", plot::Scale::logarithmic};
  for (const PairSpectra* shown : most_frequent(spectra_.pairs())) {
    const PairSpectra& pair = *shown;
    for (const auto& [bins, word] : {std::pair{&pair.normal, " (n)"}, std::pair{&pair.dissipated, " (d)"}}) {
      plot::Series series{pair.name + word, plot::SeriesStyle::line, {}, {}};
      for (std::size_t k = 0; k < bins->bins(); ++k) {
        if (bins->count(k) == 0) continue;
        series.x.push_back(std::sqrt(bins->edges()[k] * bins->edges()[k + 1]));
        series.y.push_back(static_cast<double>(bins->count(k)) / observed_);
      }
      if (series.x.size() == 1) series.style = plot::SeriesStyle::points;
      if (!series.x.empty()) figure.series.push_back(std::move(series));
    }
  }
  if (!figure.series.empty()) plot::write_figure(figure, results_ / stem_);
}

std::vector<ReportTable> CollisionEnergy::report() const {
  ReportTable table;
  table.title = fmt::format("{}: collisions in {:.4g} s ({:.0f} slower ones left out)", stem_, observed_, slow_);
  table.header = {
      "materials",           "collisions", "rate [1/s]", "normal energy [J]", "tangential energy [J]", "dissipated [J]",
      "mean dissipated [J]", "below",      "above"};
  for (const PairSpectra& pair : spectra_.pairs()) {
    const auto collisions = static_cast<double>(pair.normal.total_count());
    if (collisions == 0.0) continue;
    const double lost = pair.dissipated.total_weight();
    table.rows.push_back({pair.name, number(collisions), number(observed_ > 0.0 ? collisions / observed_ : 0.0),
                          number(pair.normal.total_weight()), number(pair.tangential.total_weight()), number(lost),
                          number(lost / collisions), std::to_string(pair.normal.below()),
                          std::to_string(pair.normal.above())});
  }
  return {table};
}

void CollisionEnergy::save(StateWriter& out) const {
  book_.save(*out.group("open"));
  spectra_.save(*out.group("spectra"));
  series_.save(*out.group("series"));
  out.write("sums", std::span<const double>{std::array{sums_.collisions, sums_.normal, sums_.tangential,
                                                       sums_.dissipated, began_, observed_, slow_, row_due_}});
}

void CollisionEnergy::load(const StateReader& in) {
  book_.load(*in.group("open"));
  spectra_.load(*in.group("spectra"));
  series_.load(*in.group("series"));
  const std::vector<double> sums = in.doubles("sums");
  sums_ = {sums.at(0), sums.at(1), sums.at(2), sums.at(3)};
  began_ = sums.at(4);
  observed_ = sums.at(5);
  slow_ = sums.at(6);
  row_due_ = sums.at(7);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::CollisionEnergy>("collision_energy",
                                                       "Spectra of the energies of collisions, by pair of materials.",
                                                       scree::CollisionEnergy::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("collision_energy", "1.0.0", &list)};
