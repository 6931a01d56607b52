// scree compare --vary time_stepper=..., --vary section.key=...: the whole scene, once for every value.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "compare_options.hpp"
#include "interrupt.hpp"
#include "run_statistics.hpp"
#include "run_to.hpp"
#include "say.hpp"
#include "scene_plugins.hpp"
#include "scree/config/scene_document.hpp"
#include "scree/config/suggest.hpp"
#include "scree/model/body_store.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/results/run_record.hpp"
#include "scree/simulation/scene_sections.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {
namespace {

/// What a run cost, and what came out.
struct RunOutcome {
  std::string value;
  std::uint64_t steps = 0;
  std::uint64_t bodies = 0;       ///< at the end
  double mean_contacts = 0.0;     ///< over the steps [1]
  PhaseTimer::Seconds seconds{};  ///< by phase [s]
  std::string state_hash;

  [[nodiscard]] double wall_time() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }  // [s]
};

/// Sections whose plugin can be exchanged as a whole.
std::vector<std::string> exchangeable_sections() {
  std::vector<std::string> names;
  for (const SceneSection& section : scene_sections()) {
    if (section.form == SectionForm::at_most_one_plugin) names.emplace_back(section.name);
  }
  names.emplace_back("narrow_phase");
  return names;
}

/// The override that puts `value` in; none when the scene has it already, with its settings.
std::vector<std::string> override_of(const CompareOptions& options, const SceneDocument& scene,
                                     const std::string& value) {
  const std::string& what = options.vary;
  if (what.find('.') != std::string::npos) return {what + "=" + value};
  const std::vector<std::string> sections = exchangeable_sections();
  if (std::find(sections.begin(), sections.end(), what) == sections.end()) {
    const std::string near = nearest_word(what, sections);
    throw Error{ErrorKind::usage,
                {"--vary", 0, 0},
                "'" + what + "' cannot be exchanged as a whole" +
                    (near.empty() ? "; " : "; did you mean '" + near + "'? ") + "valid are " + list_of(sections) +
                    ", or a setting such as simulation.time_step"};
  }
  const SceneTable root = scene.root();
  if (root.has(what) && root.table(what).has("type") && root.table(what).text("type") == value) return {};
  return {what + "={type=\"" + value + "\"}"};
}

SceneDocument scene_with(const CompareOptions& options, const std::string& value) {
  std::vector<std::string> overrides = options.overrides_without_observers();
  const SceneDocument plain = SceneDocument::load(options.scene, overrides);
  for (const std::string& change : override_of(options, plain, value)) overrides.push_back(change);
  return SceneDocument::load(options.scene, overrides);
}

SimulationSettings settings_of(const CompareOptions& options) {
  SimulationSettings settings;
  settings.threads = options.threads;
  if (!options.times.empty()) settings.end_time = options.times.back();
  return settings;
}

/// The run with one value; false after an interrupt.
bool run_one(const CompareOptions& options, RunOutcome& outcome) {
  const SceneDocument scene = scene_with(options, outcome.value);
  const PluginHost host = find_scene_plugins(scene, options.plugin_dirs);
  Simulation simulation{scene, host, settings_of(options)};
  if (!options.quiet) say("{} = {}\n", options.vary, outcome.value);
  const auto steps = static_cast<std::uint64_t>(std::llround(simulation.end_time() / simulation.time_step()));
  double contacts = 0.0;
  const bool done = run_to(simulation, steps, options.quiet, {},
                           [&](const StepRecord& step) { contacts += static_cast<double>(step.contacts); });
  outcome.steps = simulation.steps();
  outcome.bodies = simulation.bodies().size();
  outcome.mean_contacts = contacts / static_cast<double>(std::max<std::uint64_t>(1, outcome.steps));
  outcome.seconds = simulation.timer().total();
  outcome.state_hash = to_hex(simulation.state_hash());
  return done;
}

ReportTable table_of(const CompareOptions& options, const std::vector<RunOutcome>& outcomes) {
  ReportTable table{"whole runs, seconds by phase", {options.vary, "steps", "contacts", "seconds"}, {}};
  const std::vector<std::string> names = phase_names();
  std::vector<std::size_t> shown;  // phases that took any time worth a column
  for (std::size_t p = 0; p < names.size(); ++p) {
    const auto matters = [&](const RunOutcome& outcome) { return outcome.seconds[p] > 5e-3 * outcome.wall_time(); };
    if (std::any_of(outcomes.begin(), outcomes.end(), matters)) shown.push_back(p);
  }
  for (const std::size_t p : shown) table.header.push_back(names[p]);
  table.header.emplace_back("state");
  for (const RunOutcome& outcome : outcomes) {
    std::vector<std::string> row{outcome.value, std::to_string(outcome.steps),
                                 fmt::format("{:.1f}", outcome.mean_contacts),
                                 fmt::format("{:.3f}", outcome.wall_time())};
    for (const std::size_t p : shown) row.push_back(fmt::format("{:.3f}", outcome.seconds[p]));
    row.push_back(outcome.state_hash);
    table.rows.push_back(std::move(row));
  }
  return table;
}

void write_table(const CompareOptions& options, const std::vector<RunOutcome>& outcomes) {
  std::vector<CsvColumn> columns{{options.vary, ""},     {"steps", ""},      {"bodies", ""},
                                 {"mean_contacts", "1"}, {"wall_time", "s"}, {"state_hash", ""}};
  for (const std::string& name : phase_names()) columns.push_back({"seconds_" + name, "s"});
  CsvWriter table{options.output / "comparison.csv", columns};
  for (const RunOutcome& outcome : outcomes) {
    table.cell(outcome.value).cell(outcome.steps).cell(outcome.bodies).cell(outcome.mean_contacts);
    table.cell(outcome.wall_time()).cell(outcome.state_hash);
    for (const double seconds : outcome.seconds) table.cell(seconds);
    table.end_row();
  }
  table.close();
}

}  // namespace

int compare_runs(const CompareOptions& options) {
  // A value that does not fit shows before the first long run.
  for (const std::string& value : options.values) {
    const SceneDocument scene = scene_with(options, value);
    const PluginHost host = find_scene_plugins(scene, options.plugin_dirs);
    const Simulation trial{scene, host, settings_of(options)};
  }
  ResultFolder::create(options.output, options.overwrite);
  std::vector<RunOutcome> outcomes;
  for (const std::string& value : options.values) {
    RunOutcome outcome;
    outcome.value = value;
    if (!run_one(options, outcome)) return kInterrupted;
    outcomes.push_back(std::move(outcome));
  }
  write_table(options, outcomes);
  say("\n{}\ntable in {}\n", to_text(table_of(options, outcomes)), (options.output / "comparison.csv").string());
  return 0;
}

}  // namespace scree
