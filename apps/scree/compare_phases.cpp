// scree compare --vary broad_phase=... --vary narrow_phase=...: the bodies of one run, given to several collision phases.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "compare_options.hpp"
#include "interrupt.hpp"
#include "parse_time.hpp"
#include "phase_trial.hpp"
#include "plot/figure.hpp"
#include "run_statistics.hpp"
#include "run_to.hpp"
#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {
namespace {

constexpr int kFrames = 8;  // timed, after the first

/// "sphere_cluster+polyhedron" into names.
std::vector<std::string> chain_of(const std::string& words) {
  std::vector<std::string> names{""};
  for (const char c : words) {
    if (c == '+') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  return names;
}

/// The phases of the scene itself.
PhaseNames scene_phases(const Simulation& simulation) {
  PhaseNames names;
  for (const PartInfo& part : simulation.parts()) {
    if (part.kind == BroadPhase::kKind) names.broad = part.type;
    if (part.kind == NarrowPhase::kKind) names.chain.push_back(part.type);
  }
  return names;
}

/// Every broad phase with every chain; what is not varied is the scene's.
std::vector<PhaseNames> combinations(const CompareOptions& options, const PhaseNames& own) {
  const std::vector<std::string> broads = options.broad_phases.empty() ? std::vector{own.broad} : options.broad_phases;
  const std::vector<std::string> chains =
      options.narrow_phases.empty() ? std::vector{own.narrow()} : options.narrow_phases;
  std::vector<PhaseNames> all;
  for (const std::string& broad : broads) {
    for (const std::string& chain : chains) all.push_back({broad, chain_of(chain)});
  }
  return all;
}

std::string label(const PhaseTrial& trial) { return trial.names.broad + " x " + trial.names.narrow(); }

ReportTable table_of(double time, std::size_t bodies, const PhaseNames& reference,
                     const std::vector<PhaseTrial>& trials) {
  ReportTable table{fmt::format("{:.6g} s: {}; differences from {} x {}", time, counted(bodies, "body", "bodies"),
                                reference.broad, reference.narrow()),
                    {"broad_phase", "narrow_phase", "candidates", "pairs", "contacts", "first [ms]", "frame [ms]",
                     "ns/pair", "missed", "extra", "gap [r]", "normal [deg]", "fallbacks"},
                    {}};
  for (const PhaseTrial& t : trials) {
    const double pairs = static_cast<double>(std::max<std::size_t>(1, t.counts.pairs));
    table.rows.push_back({t.names.broad, t.names.narrow(), std::to_string(t.counts.candidates),
                          std::to_string(t.counts.pairs), std::to_string(t.counts.contacts),
                          fmt::format("{:.3f}", 1e3 * t.first_frame), fmt::format("{:.3f}", 1e3 * t.frame),
                          fmt::format("{:.1f}", 1e9 * t.frame / pairs), std::to_string(t.difference.missed),
                          std::to_string(t.difference.extra), fmt::format("{:.2g}", t.difference.gap),
                          fmt::format("{:.2g}", t.difference.normal_angle * 180.0 / std::numbers::pi),
                          std::to_string(t.fallbacks)});
  }
  return table;
}

/// comparison.csv: one row a moment and combination.
class PhaseLog {
 public:
  explicit PhaseLog(const std::filesystem::path& file)
      : table_{file,
               {{"time", "s"},
                {"bodies", ""},
                {"broad_phase", ""},
                {"narrow_phase", ""},
                {"candidates", ""},
                {"pairs", ""},
                {"contacts", ""},
                {"first_frame", "s"},
                {"frame", "s"},
                {"missed", ""},
                {"extra", ""},
                {"gap_difference", "1"},
                {"normal_angle", "rad"},
                {"fallbacks", ""}}} {}
  void add(double time, std::size_t bodies, const PhaseTrial& t) {
    table_.cell(time).cell(std::uint64_t{bodies}).cell(t.names.broad).cell(t.names.narrow());
    table_.cell(std::uint64_t{t.counts.candidates}).cell(std::uint64_t{t.counts.pairs});
    table_.cell(std::uint64_t{t.counts.contacts}).cell(t.first_frame).cell(t.frame);
    table_.cell(std::uint64_t{t.difference.missed}).cell(std::uint64_t{t.difference.extra}).cell(t.difference.gap);
    table_.cell(t.difference.normal_angle).cell(t.fallbacks).end_row();
  }
  void close() { table_.close(); }

 private:
  CsvWriter table_;
};

/// Time of a frame by moment, a line a combination.
void draw(const std::vector<double>& times, const std::vector<std::vector<PhaseTrial>>& trials,
          const std::filesystem::path& folder) {
  plot::Figure figure;
  figure.title = "Collision: time of a frame";
  figure.x = {"simulated time [s]", plot::Scale::linear, {}};
  figure.y = {"time of a frame [ms]", plot::Scale::logarithmic, {}};
  for (std::size_t k = 0; k < trials[0].size(); ++k) {
    plot::Series series{
        label(trials[0][k]), times.size() > 1 ? plot::SeriesStyle::line : plot::SeriesStyle::points, {}, {}};
    for (std::size_t m = 0; m < times.size(); ++m) {
      series.x.push_back(times[m]);
      series.y.push_back(1e3 * trials[m][k].frame);
    }
    figure.series.push_back(std::move(series));
  }
  write_figure(figure, folder / "frame_time");
}

/// All combinations at one moment, compared with brute force and the scene's own chain.
std::vector<PhaseTrial> try_all(const CompareOptions& options, const PluginHost& host, const Simulation& simulation,
                                const PhaseNames& reference) {
  const Executor executor{options.threads};
  PhaseScene scene{&simulation.shapes(), simulation.bodies(), simulation.collision_filter(), simulation.time_step()};
  const PhaseTrial expected = try_phases(host, reference, scene, 1, executor);
  std::vector<PhaseTrial> trials;
  for (const PhaseNames& names : combinations(options, scene_phases(simulation))) {
    PhaseTrial trial = try_phases(host, names, scene, kFrames, executor);
    trial.difference = difference_of(trial.contacts, expected.contacts, scene.bodies.view());
    trial.contacts = {};
    trials.push_back(std::move(trial));
  }
  return trials;
}

}  // namespace

int compare_phases(const CompareOptions& options) {
  const SceneDocument document = SceneDocument::load(options.scene, options.overrides_without_observers());
  const PluginHost host = find_scene_plugins(document, options.plugin_dirs);
  Simulation simulation{document, host, {options.threads, {}, {}}};
  const std::vector<double> times = options.times.empty() ? std::vector{simulation.end_time()} : options.times;
  const PhaseNames reference{"brute_force", scene_phases(simulation).chain};
  // Wrong names show before the run.
  for (const PhaseNames& names : combinations(options, reference)) {
    static_cast<void>(host.entry(BroadPhase::kKind, names.broad, {"--vary", 0, 0}));
    for (const std::string& name : names.chain) {
      static_cast<void>(host.entry(NarrowPhase::kKind, name, {"--vary", 0, 0}));
    }
  }
  ResultFolder::create(options.output, options.overwrite);
  PhaseLog log{options.output / "comparison.csv"};
  std::vector<std::vector<PhaseTrial>> trials;
  for (const double time : times) {
    const std::uint64_t steps = step_at(time, simulation, "--at");
    if (!run_to(simulation, steps, options.quiet, {}, {})) return kInterrupted;
    trials.push_back(try_all(options, host, simulation, reference));
    for (const PhaseTrial& trial : trials.back()) log.add(simulation.time(), simulation.bodies().size(), trial);
    say("\n{}", to_text(table_of(simulation.time(), simulation.bodies().size(), reference, trials.back())));
  }
  log.close();
  draw(times, trials, options.output);
  say("\ntable and plot in {}\n", options.output.string());
  return 0;
}

}  // namespace scree
