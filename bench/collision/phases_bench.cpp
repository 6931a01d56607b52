// Every scene with every broad phase and every chain of narrow phases: cost, and differences from brute force with the
// default chain.
//
//     phases_bench [--bodies N] [--scenes A,B] [--broad A,B] [--narrow A+B,C] [--frames N] [--output FOLDER]
//
// Prints a table; with a folder also phases.csv and, as SVG and PNG, the time a body and frame. Bodies go one step of 1 ms forth
// and back. Wall time, one thread. A chain that does not support the kinds of a scene, or throws, is listed with the reason.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <numbers>

#include "phase_trial.hpp"
#include "plot/figure.hpp"
#include "plugins.hpp"
#include "scenes.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/results/run_record.hpp"

namespace scree::bench {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> words{""};
  for (const char c : text) {
    if (c == at) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

struct Settings {
  std::size_t bodies = 8000;
  int frames = 6;
  std::vector<std::string> scenes = scene_names();
  std::vector<std::string> broad{"grid", "bullet_dbvt", "bullet_sap", "fcl_tree", "brute_force"};
  std::vector<std::string> narrow;
  std::filesystem::path output;
};

struct Row {
  std::string scene;
  std::size_t bodies = 0;
  PhaseTrial trial;
  std::string hash, failure;
};

/// The installed ones of scree's chain.
std::string default_chain() {
  std::string chain;
  for (const char* name : {"sphere_cluster", "polyhedron", "bullet", "fcl"}) {
    if (is_built("narrow_phase", name)) chain += (chain.empty() ? "" : "+") + std::string{name};
  }
  return chain;
}

Settings read_arguments(int argc, char** argv) {
  Settings settings;
  settings.narrow = {default_chain()};
  for (const char* name : {"bullet", "fcl"}) {
    if (is_built("narrow_phase", name)) settings.narrow.emplace_back(name);
  }
  for (int k = 1; k < argc; ++k) {
    const std::string key = argv[k];
    if (key.starts_with("--benchmark")) continue;  // what `./dev bench` gives to all
    if (k + 1 == argc) throw std::runtime_error{key + " needs a value, or is no option of phases_bench"};
    const std::string value = argv[++k];
    if (key == "--bodies") settings.bodies = std::stoul(value);
    if (key == "--frames") settings.frames = std::stoi(value);
    if (key == "--scenes") settings.scenes = split(value, ',');
    if (key == "--broad") settings.broad = split(value, ',');
    if (key == "--narrow") settings.narrow = split(value, ',');
    if (key == "--output") settings.output = value;
  }
  return settings;
}

void print(const Row& row) {
  const PhaseTrial& t = row.trial;
  if (!row.failure.empty()) {
    fmt::print("{:<13} {:<12} {:<24} {}\n", row.scene, t.names.broad, t.names.narrow(), row.failure);
    return;
  }
  fmt::print("{:<13} {:<12} {:<24} {:>8} {:>8} {:>8} {:>9.2f} {:>7.0f} {:>6} {:>6} {:>8.1e} {:>8.1e} {:>5} {}\n",
             row.scene, t.names.broad, t.names.narrow(), t.counts.candidates, t.counts.pairs, t.counts.contacts,
             1e3 * t.frame, 1e9 * t.frame / static_cast<double>(std::max<std::size_t>(1, t.counts.pairs)),
             t.difference.missed, t.difference.extra, t.difference.gap,
             t.difference.normal_angle * 180.0 / std::numbers::pi, t.fallbacks, row.hash);
  std::fflush(stdout);
}

Row try_one(PhaseScene& scene, const Scene& source, const PhaseNames& names, int frames,
            const std::vector<Contact>& expected) {
  Row row{.scene = source.name, .bodies = source.bodies.size(), .trial = {}, .hash = {}, .failure = {}};
  try {
    row.trial = try_phases(plugin_host(), names, scene, frames, Executor{1});
    row.trial.difference = difference_of(row.trial.contacts, expected, scene.bodies.view());
    row.trial.contacts = {};
    row.hash = to_hex(scene.bodies.hash());
  } catch (const std::exception& problem) {
    row.trial = {.names = names, .counts = {}, .contacts = {}, .difference = {}};
    row.failure = problem.what();
  }
  return row;
}

void write_csv(const std::filesystem::path& file, const std::vector<Row>& rows) {
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (out == nullptr) throw std::runtime_error{"cannot write " + file.string()};
  fmt::print(out,
             "scene,bodies,broad_phase,narrow_phase,candidates,pairs,contacts,first_frame [s],frame [s],missed,extra,"
             "gap_difference [1],normal_angle [rad],fallbacks,state_hash,failure\n");
  for (const Row& r : rows) {
    const PhaseTrial& t = r.trial;
    fmt::print(out, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},\"{}\"\n", r.scene, r.bodies, t.names.broad,
               t.names.narrow(), t.counts.candidates, t.counts.pairs, t.counts.contacts, t.first_frame, t.frame,
               t.difference.missed, t.difference.extra, t.difference.gap, t.difference.normal_angle, t.fallbacks,
               r.hash, r.failure);
  }
  std::fclose(out);
}

/// Time a body and frame: a place on the x axis for each scene, a colour for each combination.
void draw(const std::filesystem::path& stem, const Settings& settings, const std::vector<Row>& rows) {
  plot::Figure figure;
  figure.title = "Collision: time a body and frame";
  figure.note = fmt::format("about {} bodies a scene, one thread", settings.bodies);
  figure.x = {"scene", plot::Scale::linear, std::pair{0.0, static_cast<double>(settings.scenes.size())}};
  figure.y = {"time a body and frame [us]", plot::Scale::logarithmic, {}};
  figure.width = 1200;
  std::map<std::string, plot::Series> series;
  for (std::size_t s = 0; s < settings.scenes.size(); ++s) {
    figure.regions.push_back({static_cast<double>(s), static_cast<double>(s + 1), settings.scenes[s]});
    for (const Row& row : rows) {
      if (row.scene != settings.scenes[s] || !row.failure.empty()) continue;
      const std::string name = row.trial.names.broad + " x " + row.trial.names.narrow();
      plot::Series& line =
          series.try_emplace(name, plot::Series{name, plot::SeriesStyle::points, {}, {}}).first->second;
      line.x.push_back(static_cast<double>(s) + 0.5);
      line.y.push_back(1e6 * row.trial.frame / static_cast<double>(row.bodies));
    }
  }
  for (auto& [name, line] : series) figure.series.push_back(std::move(line));
  write_figure(figure, stem);
}

void run(const Settings& settings) {
  fmt::print("{:<13} {:<12} {:<24} {:>8} {:>8} {:>8} {:>9} {:>7} {:>6} {:>6} {:>8} {:>8} {:>5} {}\n", "scene",
             "broad_phase", "narrow_phase", "candid.", "pairs", "contacts", "frame ms", "ns/pair", "missed", "extra",
             "gap [r]", "deg", "fallb", "state");
  std::vector<Row> rows;
  for (const std::string& name : settings.scenes) {
    const auto source = make_scene(name, settings.bodies);
    PhaseScene scene{&source->shapes, source->bodies, {}, 1e-3};
    const PhaseNames reference{"brute_force", split(default_chain(), '+')};
    const std::vector<Contact> expected = try_phases(plugin_host(), reference, scene, 1, Executor{1}).contacts;
    for (const std::string& broad : settings.broad) {
      for (const std::string& narrow : settings.narrow) {
        rows.push_back(try_one(scene, *source, {broad, split(narrow, '+')}, settings.frames, expected));
        print(rows.back());
      }
    }
  }
  if (settings.output.empty()) return;
  std::filesystem::create_directories(settings.output);
  write_csv(settings.output / "phases.csv", rows);
  draw(settings.output / "phases", settings, rows);
}

}  // namespace
}  // namespace scree::bench

int main(int argc, char** argv) {
  try {
    scree::bench::run(scree::bench::read_arguments(argc, argv));
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "phases_bench: {}\n", problem.what());
    return 1;
  }
}
