#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <utility>

#include "scree/base/release.hpp"
#include "scree/model/kinetic_energy.hpp"
#include "scree/simulation/scene_machine.hpp"
#include "scree/simulation/simulation_state.hpp"

namespace scree {
namespace {

constexpr std::size_t kManyBorn = 1000;  // in a step
constexpr std::size_t kGrain = 4096;

}  // namespace

Observation Simulation::State::observation(std::uint64_t step) const {
  return {bodies.view(), parts.stepper.plugin->contacts(), removed, static_cast<double>(step) * time_step, time_step,
          step};
}

void Simulation::State::feed_sources() {
  if (fed_this_step) return;  // resumed from a checkpoint that was written in mid-step
  const PhaseTimer::Scope scope{timer, Phase::sources};
  births.start();
  for (std::size_t k = 0; k < parts.sources.size(); ++k) {
    const Part<Source>& source = parts.sources[k];
    born.clear();
    births.expect(static_cast<BodyIndex>(bodies.size()), source.info);
    services->serve(source.info);
    guarded(source.info, ErrorKind::diverged, [&] { source.plugin->emit(bodies.view(), time(), time_step, born); });
    if (born.size() > kManyBorn) bodies.reserve(bodies.size() + born.size());
    for (NewBody& body : born) {
      body.collision_group = source_groups[k];
      add(std::move(body));
      energy.fed_kinetic += kinetic_energy(bodies.view(), static_cast<BodyIndex>(bodies.size() - 1));
    }
    // A bed of all particles at once is not kept twice for the rest of the run.
    if (born.size() > kManyBorn) release(born);
  }
  fed_this_step = true;
}

StepSummary Simulation::State::advance() {
  const PhaseTimer::Scope scope{timer, Phase::stepper};
  services->serve(parts.stepper.info);  // for its lines in the log
  return guarded(parts.stepper.info, ErrorKind::diverged,
                 [&] { return parts.stepper.plugin->step(*host, bodies.state(), time(), time_step); });
}

void Simulation::State::check_motion() const {
  const BodyView view = bodies.view();
  const auto is_sound = [&](std::size_t i) {
    // A single comparison catches NaN as well.
    return is_finite(view.position[i]) && is_finite(view.angular_velocity[i]) &&
           squared_norm(view.velocity[i]) <= max_speed * max_speed;
  };
  std::atomic<bool> all_sound{true};
  executor.for_chunks(view.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (!is_sound(i)) all_sound = false;
  });
  if (all_sound) return;
  std::size_t i = 0;
  while (is_sound(i)) ++i;
  char text[200];
  std::snprintf(text, sizeof text,
                " moves at %.4g m/s at t = %.6g s, above simulation.max_speed = %.4g m/s; take a smaller time_step, or "
                "look at the forces on that body",
                norm(view.velocity[i]), time() + time_step, max_speed);
  throw Error{ErrorKind::diverged, "body " + std::to_string(view.id[i]) + text};
}

void Simulation::State::advance_fields(double end) {
  const PhaseTimer::Scope scope{timer, Phase::fields};
  for (const Part<ForceField>& field : parts.forces) {
    if (field.plugin->is_steady()) continue;  // and contacts need not be told for its sake
    services->serve(field.info);
    guarded(field.info, ErrorKind::diverged, [&] {
      field.plugin->advance(bodies.view(), parts.stepper.plugin->contacts(), bodies.attributes(), end, time_step);
    });
  }
}

void Simulation::State::observe() {
  const PhaseTimer::Scope scope{timer, Phase::observers};
  if (parts.observers.empty()) return;
  const Observation now = observation(steps + 1);
  for (const Part<Observer>& observer : parts.observers) {
    services->serve(observer.info);
    guarded(observer.info, ErrorKind::diverged, [&] { observer.plugin->observe(now, bodies.attributes()); });
  }
}

void Simulation::State::remove_bodies(double at) {
  const PhaseTimer::Scope scope{timer, Phase::sinks};
  std::vector<RemovedBody> now;
  const BodyView view = bodies.view();
  leaving.assign(parts.sinks.empty() ? 0 : view.size(), 0);
  std::vector<char> before;
  for (const Part<Sink>& sink : parts.sinks) {
    before = leaving;
    services->serve(sink.info);
    guarded(sink.info, ErrorKind::diverged, [&] { sink.plugin->mark(view, at, leaving); });
    for (std::size_t i = 0; i < view.size(); ++i) {
      if (view.motion[i] != Motion::dynamic) leaving[i] = 0;
      if (leaving[i] == 0 || before[i] != 0) continue;
      now.push_back(
          {view.id[i], view.material[i], view.mass[i], at, view.position[i], sink.info.name, sink.plugin->reason()});
    }
  }
  // Counted when every sink has spoken: one that throws undoes the step.
  removed = std::move(now);
  for (std::size_t i = 0; i < leaving.size(); ++i) {
    if (leaving[i] != 0) energy.fed_kinetic -= kinetic_energy(view, static_cast<BodyIndex>(i));
  }
  for (const RemovedBody& body : removed) feed.removed[body.material].add(body.mass);
  if (!removed.empty()) bodies.remove(leaving);
}

StepSummary Simulation::State::take_step() {
  const bool keeps_late = parts.stepper.plugin->announces_motion();
  if (!keeps_late) backup.keep(bodies, executor);
  machine->keep();
  try {
    const double end = static_cast<double>(steps + 1) * time_step;
    motions.begin_step(bodies, end, time_step);
    const StepSummary summary = advance();
    if (!backup.kept()) backup.keep(bodies, executor);  // the stepper had nothing to move
    motions.end_step(bodies);
    check_motion();
    host->tap_next({});
    advance_fields(end);
    admit_parted(model, *machine, parted, pipeline->filter());
    log.insert(log.end(), machine->news().begin(), machine->news().end());
    observe();
    remove_bodies(end);
    ++steps;
    energy.work += summary.work;
    fed_this_step = false;
    keeps_late ? backup.release_memory() : backup.forget();
    return summary;
  } catch (...) {
    backup.restore(bodies);
    machine->undo();
    motions.undo(bodies);
    backup.forget();
    failed = true;
    throw;
  }
}

StepRecord Simulation::State::record(const StepSummary& summary) {
  StepRecord record;
  std::uint64_t fallbacks_now = 0;
  for (const Part<NarrowPhase>& phase : parts.narrow) fallbacks_now += phase.plugin->fallbacks();
  record.fallbacks = fallbacks_now - std::exchange(fallbacks, fallbacks_now);
  record.step = steps;
  record.time = time();
  record.contacts = summary.contacts;
  record.iterations = static_cast<std::uint64_t>(summary.solve.iterations);
  record.residual = summary.solve.residual;
  record.status = to_string(summary.solve.status);
  record.mean_penetration = summary.mean_penetration;
  record.max_penetration = summary.max_penetration;
  record.energy = energy;
  const BodyView view = bodies.view();
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (view.motion[i] != Motion::dynamic) continue;
    ++record.bodies;
    record.energy.kinetic += kinetic_energy(view, static_cast<BodyIndex>(i));
  }
  for (const Part<ForceField>& field : parts.forces) {
    guarded(field.info, ErrorKind::diverged, [&] {
      if (field.plugin->is_conservative()) record.energy.potential += field.plugin->potential_energy(view, time());
    });
  }
  return record;
}

Simulation::Simulation(const SceneDocument& document, const PluginCatalog& catalog, const SimulationSettings& settings)
    : state_{std::make_unique<State>(document, catalog, settings)} {}

Simulation::~Simulation() = default;

StepRecord Simulation::step() {
  state_->feed_sources();
  const StepSummary summary = state_->take_step();
  return state_->record(summary);
}

void Simulation::try_first_step() {
  State& s = *state_;
  // Steppers of hard contacts refuse nothing, and may take long.
  if (!s.parts.stepper.plugin->needs_contact_law()) return;
  s.feed_sources();
  s.motions.begin_step(s.bodies, s.time_step, s.time_step);
  (void)s.advance();
}

void Simulation::finish() {
  State& s = *state_;
  const PhaseTimer::Scope scope{s.timer, Phase::observers};
  const Observation last = s.observation(s.steps);
  for (const Part<Observer>& observer : s.parts.observers) {
    s.services->serve(observer.info);
    guarded(observer.info, ErrorKind::io, [&] { observer.plugin->finish(last); });
  }
}

double Simulation::time() const { return state_->time(); }
double Simulation::end_time() const { return state_->end_time; }
double Simulation::time_step() const { return state_->time_step; }
std::uint64_t Simulation::steps() const { return state_->steps; }
bool Simulation::is_done() const { return state_->steps >= state_->last_step; }
std::uint64_t Simulation::state_hash() const { return state_->bodies.hash(); }
const BodyStore& Simulation::bodies() const { return state_->bodies; }
const Materials& Simulation::materials() const { return state_->model.materials; }
const ShapeSet& Simulation::shapes() const { return state_->model.shapes; }
const CollisionFilter& Simulation::collision_filter() const { return state_->pipeline->filter(); }
bool Simulation::poses_contact_problems() const { return state_->parts.stepper.plugin->needs_ccp_solver(); }
const Machine& Simulation::machine() const { return *state_->machine; }
const FeedRecord& Simulation::feed() const { return state_->feed; }
PhaseTimer& Simulation::timer() { return state_->timer; }
const std::vector<RemovedBody>& Simulation::removed() const { return state_->removed; }
const std::vector<std::string>& Simulation::log() const { return state_->log; }
const std::vector<std::string>& Simulation::warnings() const { return state_->warnings; }
std::int64_t Simulation::steps_every() const { return state_->model.output.integer("steps_every"); }
double Simulation::checkpoint_interval() const { return state_->model.output.number("checkpoint_interval"); }
std::uint64_t Simulation::seed() const { return static_cast<std::uint64_t>(state_->model.simulation.integer("seed")); }

namespace {

std::string three_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// Which narrow phases fell back, and how often; no rows when none did.
ReportTable fallback_table(const std::vector<Part<NarrowPhase>>& phases) {
  ReportTable table{"pairs that a narrow phase computed by its fallback", {"narrow phase", "pairs"}, {}};
  for (const Part<NarrowPhase>& phase : phases) {
    const std::uint64_t pairs = phase.plugin->fallbacks();
    if (pairs > 0) table.rows.push_back({phase.info.name, std::to_string(pairs)});
  }
  return table;
}

/// What the motors gave; no rows without.
ReportTable motor_table(const Machine& machine) {
  ReportTable table{"motors", {"motor", "effort at the end", "power at the end [W]", "energy given [J]"}, {}};
  const MachineDescription& m = machine.description();
  for (std::size_t k = 0; k < m.motors.size(); ++k) {
    const MachineReport& report = machine.reports()[m.joints.size() + k];
    const bool turns = m.motors[k].coordinate == Coordinate::rotation;
    const std::string effort =
        turns ? three_digits(report.effort_torque) + " N m" : three_digits(report.effort_force) + " N";
    table.rows.push_back({m.motors[k].name, effort, three_digits(report.power), three_digits(report.energy)});
  }
  return table;
}

}  // namespace

std::vector<ReportTable> Simulation::report() const {
  std::vector<ReportTable> tables;
  if (ReportTable table = motor_table(*state_->machine); !table.rows.empty()) tables.push_back(std::move(table));
  if (ReportTable table = fallback_table(state_->parts.narrow); !table.rows.empty()) tables.push_back(std::move(table));
  for (const Part<Source>& source : state_->parts.sources) {
    for (ReportTable& table : source.plugin->report()) tables.push_back(std::move(table));
  }
  for (const Part<Observer>& observer : state_->parts.observers) {
    for (ReportTable& table : observer.plugin->report()) tables.push_back(std::move(table));
  }
  return tables;
}

std::vector<PartInfo> Simulation::parts() const {
  std::vector<PartInfo> infos;
  state_->parts.for_each([&](const PartInfo& info, const Options&, Plugin&) { infos.push_back(info); });
  return infos;
}

}  // namespace scree
