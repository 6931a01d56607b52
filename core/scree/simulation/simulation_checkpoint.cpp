// How a simulation is described, saved and continued.
#include <xxhash.h>

#include <algorithm>

#include "scree/ccp/ccp_file.hpp"
#include "scree/config/resolved.hpp"
#include "scree/config/suggest.hpp"
#include "scree/results/run_record.hpp"
#include "scree/simulation/kept_options.hpp"
#include "scree/simulation/scene_difference.hpp"
#include "scree/simulation/scene_machine.hpp"
#include "scree/simulation/simulation_state.hpp"
#include "scree/state/hdf5_checkpoint.hpp"

namespace scree {
namespace {

void append(std::string& json, const std::string& key, const std::string& value) {
  json += (json.size() > 1 ? ",\n  \"" : "\n  \"") + key + "\": " + value;
}

std::string list_json(const std::vector<std::string>& items) {
  std::string text = "[";
  for (const std::string& item : items) text += (text.size() > 1 ? ", " : "") + item;
  return text + "]";
}

/// A part's options with `type` and `name` in front.
std::string part_json(const PartInfo& info, const Options& options) {
  Options named = options;
  named.set("name", Parameter::Value{info.name});
  return to_json_text(named, -1);
}

std::string named_json(const std::vector<NamedOptions>& tables) {
  std::string text = "{";
  for (const NamedOptions& table : tables) {
    text += (text.size() > 1 ? ", \"" : "\"") + table.name + "\": " + to_json_text(table.options, -1);
  }
  return text + "}";
}

std::string pair_table_json(const Materials& materials) {
  std::vector<std::string> rows;
  for (std::uint32_t a = 0; a < materials.size(); ++a) {
    for (std::uint32_t b = a; b < materials.size(); ++b) {
      const ContactMaterial& p = materials.pair(a, b);
      Options row;
      row.set("between", Parameter::Value{std::vector<std::string>{materials[a].name, materials[b].name}});
      row.set("listed", Parameter::Value{materials.is_listed(a, b)});
      row.set("friction", Parameter::Value{p.friction});
      row.set("restitution", Parameter::Value{p.restitution});
      row.set("rolling_friction", Parameter::Value{p.rolling_friction});
      row.set("spinning_friction", Parameter::Value{p.spinning_friction});
      row.set("compliance", Parameter::Value{p.compliance});
      row.set("damping", Parameter::Value{p.damping});
      rows.push_back(to_json_text(row, -1));
    }
  }
  return list_json(rows);
}

void append_machine(std::string& json, const SceneModel& model) {
  for (const char* section : {"joint", "motor", "coupling"}) {
    std::vector<std::string> tables;
    for (const auto& [of, options] : model.machine_options) {
      if (of == section) tables.push_back(to_json_text(options, -1));
    }
    if (!tables.empty()) append(json, section, list_json(tables));
  }
}

/// The scene as JSON. With `motion_only`, without what does not decide how bodies move.
std::string describe(const SceneModel& model, const Parts& parts, bool motion_only) {
  std::string json = "{";
  if (!motion_only) append(json, "simulation", to_json_text(model.simulation, -1));
  if (motion_only) {
    Options timing;
    timing.set("time_step", Parameter::Value{model.simulation.number("time_step")});
    timing.set("seed", Parameter::Value{model.simulation.integer("seed")});
    append(json, "simulation", to_json_text(timing, -1));
  }
  append(json, "contacts", to_json_text(model.contacts, -1));
  append(json, "material", named_json(model.material_options));
  append(json, "material_pair", pair_table_json(model.materials));
  append(json, "shape", named_json(model.shape_options));
  std::vector<std::string> bodies;
  for (const SceneBody& body : model.bodies) bodies.push_back(to_json_text(body.options, -1));
  append(json, "body", list_json(bodies));
  append(json, "collision_group", named_json(model.collision_group_options));
  std::vector<std::string> excluded;
  for (const Options& pair : model.excluded_pair_options) excluded.push_back(to_json_text(pair, -1));
  append(json, "excluded_pair", list_json(excluded));
  if (!model.motion_options.empty()) {
    std::vector<std::string> motions;
    for (const Options& motion : model.motion_options) motions.push_back(to_json_text(motion, -1));
    append(json, "prescribed_motion", list_json(motions));
  }
  append_machine(json, model);
  std::string kind;
  std::vector<std::string> list;
  const auto flush = [&] {
    if (!kind.empty()) append(json, kind, list_json(list));
    list.clear();
  };
  parts.for_each([&](const PartInfo& info, const Options& options, Plugin&) {
    if (motion_only && info.kind == Observer::kKind) return;
    if (info.kind != kind) flush();
    kind = info.kind;
    Options shown = options;
    if (info.kind == CcpSolver::kKind) {
      shown.set("tolerance", Parameter::Value{parts.solver_tolerance});
      shown.set("max_iterations", Parameter::Value{std::int64_t{parts.solver_iterations}});
      shown.set("active_set", Parameter::Value{parts.active_set});
    }
    if (info.kind == Source::kKind) {
      shown.set("collision_group", Parameter::Value{parts.sources[list.size()].core.text("collision_group")});
    }
    list.push_back(part_json(info, shown));
  });
  flush();
  if (!motion_only) append(json, "output", to_json_text(model.output, -1));
  return json + "\n}";
}

/// Bodies that observers have not heard of yet: their removal is told in the next step.
void save_removed(const std::vector<RemovedBody>& removed, StateWriter& out) {
  std::vector<std::uint64_t> id, material;
  std::vector<double> mass, time;
  std::vector<Vec3> position;
  out.write("count", std::uint64_t{removed.size()});
  for (std::size_t i = 0; i < removed.size(); ++i) {
    id.push_back(removed[i].id);
    material.push_back(removed[i].material);
    mass.push_back(removed[i].mass);
    time.push_back(removed[i].time);
    position.push_back(removed[i].position);
    out.write("sink_" + std::to_string(i), std::string_view{removed[i].sink});
    out.write("reason_" + std::to_string(i), std::string_view{removed[i].reason});
  }
  out.write("id", std::span<const std::uint64_t>{id});
  out.write("material", std::span<const std::uint64_t>{material});
  out.write("mass", std::span<const double>{mass});
  out.write("time", std::span<const double>{time});
  out.write("position", std::span<const Vec3>{position});
}

std::vector<RemovedBody> load_removed(const StateReader& in) {
  const std::vector<std::uint64_t> id = in.integers("id"), material = in.integers("material");
  const std::vector<double> mass = in.doubles("mass"), time = in.doubles("time");
  const std::vector<Vec3> position = in.vectors("position");
  std::vector<RemovedBody> removed;
  for (std::size_t i = 0; i < in.integer("count"); ++i) {
    removed.push_back({id.at(i), static_cast<std::uint32_t>(material.at(i)), mass.at(i), time.at(i), position.at(i),
                       in.text("sink_" + std::to_string(i)), in.text("reason_" + std::to_string(i))});
  }
  return removed;
}

/// The settings that differ from those in the run.json beside a checkpoint, as a part of a sentence; empty when they are not known.
std::string what_differs(const std::filesystem::path& checkpoint, const std::string& hash, const std::string& scene) {
  constexpr std::size_t kNamed = 5;
  const std::vector<std::string> keys = differing_settings(scene_beside(checkpoint, hash), scene);
  if (keys.empty()) return {};
  if (keys.size() == 1) return ": '" + keys.front() + "' differs";
  if (keys.size() <= kNamed) return ": " + list_of(keys) + " differ";
  std::string named;
  for (std::size_t i = 0; i < kNamed; ++i) named += (i > 0 ? ", '" : "'") + keys[i] + "'";
  return ": " + named + " and " + std::to_string(keys.size() - kNamed) + " more differ";
}

std::string group_name(const PartInfo& info) { return info.kind + ":" + info.name; }

}  // namespace

std::string Simulation::resolved_scene() const {
  const State& s = *state_;
  return describe(s.model, s.parts, false);
}

std::string Simulation::scene_hash() const {
  const State& s = *state_;
  const std::string text = describe(s.model, s.parts, true);
  return to_hex(XXH3_64bits(text.data(), text.size()));
}

void Simulation::State::save_to(StateWriter& out) const {
  const auto run = out.group("simulation");
  run->write("steps", steps);
  run->write("fed_this_step", std::uint64_t{fed_this_step});
  std::vector<std::uint64_t> counts;
  std::vector<double> masses;
  for (const auto* amounts : {&feed.fed, &feed.removed}) {
    for (const Amount& amount : *amounts) {
      counts.push_back(amount.count);
      masses.push_back(amount.mass);
    }
  }
  run->write("amount_counts", std::span<const std::uint64_t>{counts});
  run->write("amount_masses", std::span<const double>{masses});
  energy.save(*out.group("energy"));
  save_removed(removed, *out.group("removed"));
  model.shapes.save(*out.group("shapes"));
  bodies.save(*out.group("bodies"));
  machine->save(*out.group("machine"));
  parts.for_each([&](const PartInfo& info, const Options& options, Plugin& plugin) {
    // A step that failed leaves the stepper's memory in doubt: the continuation starts it afresh.
    if (failed && info.kind == TimeStepper::kKind) return;
    const auto group = out.group(group_name(info));
    group->write("type", std::string_view{info.type});
    group->write("version", static_cast<std::uint64_t>(plugin.version()));
    info.kind == Observer::kKind ? save_observer(options, plugin, *group) : plugin.save(*group);
  });
}

void Simulation::State::restore_from(const StateReader& in) {
  const auto run = in.group("simulation");
  steps = run->integer("steps");
  fed_this_step = run->integer("fed_this_step") != 0;
  const std::vector<std::uint64_t> counts = run->integers("amount_counts");
  const std::vector<double> masses = run->doubles("amount_masses");
  const std::size_t materials = model.materials.size();
  if (counts.size() != 2 * materials || masses.size() != 2 * materials) {
    throw Error{ErrorKind::io, "the checkpoint was written with another number of materials"};
  }
  for (std::size_t m = 0; m < materials; ++m) {
    feed.fed[m] = {counts[m], masses[m]};
    feed.removed[m] = {counts[materials + m], masses[materials + m]};
  }
  energy.load(*in.group("energy"));
  removed = load_removed(*in.group("removed"));
  model.shapes.load(*in.group("shapes"));
  bodies.load(*in.group("bodies"));
  machine->load(*in.group("machine"));
  admit_parted(model, *machine, parted, pipeline->filter());
  parts.for_each([&](const PartInfo& info, const Options& options, Plugin& plugin) {
    if (!in.has(group_name(info))) return;  // new since the checkpoint, an observer say: it starts afresh
    const auto group = in.group(group_name(info));
    if (group->text("type") != info.type || group->integer("version") != static_cast<std::uint64_t>(plugin.version())) {
      throw Error{ErrorKind::usage, info.label_with_library() + " cannot read the state of '" + group->text("type") +
                                        "' version " + std::to_string(group->integer("version")) +
                                        " in the checkpoint; use the version that wrote it"};
    }
    if (info.kind == Observer::kKind) check_kept_options(info, options, *group);
    guarded(info, ErrorKind::io, [&] { plugin.load(*group); });
  });
}

void Simulation::save(const std::filesystem::path& file) const {
  CheckpointWriter writer{{scene_hash(), SCREE_VERSION}};
  state_->save_to(writer.root());
  writer.save_as(file);
}

void Simulation::record_problem(const std::filesystem::path& file) {
  State& s = *state_;
  if (!s.parts.solver) {
    throw Error{ErrorKind::usage, "there is no contact problem to record: the scene has no [ccp_solver]"};
  }
  const CcpOrigin origin{scene_hash(),
                         SCREE_VERSION,
                         static_cast<double>(s.steps + 1) * s.time_step,
                         s.steps + 1,
                         s.parts.solver_tolerance,
                         s.parts.solver_iterations};
  s.host->tap_next([file, origin](const CcpProblem& problem, std::span<const double> guess) {
    write_ccp_file(file, make_ccp_record(problem, guess, origin));
  });
}

void Simulation::resume(const std::filesystem::path& file) {
  const CheckpointReader reader{file};
  if (reader.header().scene_hash != scene_hash()) {
    throw Error{ErrorKind::usage, file.string() + " was written by another scene (its hash is " +
                                      reader.header().scene_hash + ", that of this one " + scene_hash() + ")" +
                                      what_differs(file, reader.header().scene_hash, resolved_scene()) +
                                      "; only end_time, output and observers may change before a run is continued"};
  }
  state_->restore_from(reader.root());
}

}  // namespace scree
