#include "scree/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "scree/simulation/simulation_state.hpp"

namespace scree {
namespace {

constexpr std::size_t kManyBorn = 1000;  // in a step

}  // namespace

void MotionBackup::keep(const BodyView& bodies) {
  position.assign(bodies.position.begin(), bodies.position.end());
  orientation.assign(bodies.orientation.begin(), bodies.orientation.end());
  velocity.assign(bodies.velocity.begin(), bodies.velocity.end());
  angular_velocity.assign(bodies.angular_velocity.begin(), bodies.angular_velocity.end());
}

void MotionBackup::restore(const BodyState& bodies) const {
  std::copy(position.begin(), position.end(), bodies.position.begin());
  std::copy(orientation.begin(), orientation.end(), bodies.orientation.begin());
  std::copy(velocity.begin(), velocity.end(), bodies.velocity.begin());
  std::copy(angular_velocity.begin(), angular_velocity.end(), bodies.angular_velocity.begin());
}

Observation Simulation::State::observation(double at) const {
  return {bodies.view(), parts.stepper.plugin->contacts(), removed, at, time_step, steps};
}

void Simulation::State::feed_sources() {
  if (fed_this_step) return;  // resumed from a checkpoint that was written in mid-step
  const PhaseTimer::Scope scope{timer, Phase::sources};
  for (const Part<Source>& source : parts.sources) {
    born.clear();
    guarded(source.info, ErrorKind::diverged, [&] { source.plugin->emit(bodies.view(), time(), time_step, born); });
    for (NewBody& body : born) add(std::move(body));
    // A bed of all particles at once is not kept twice for the rest of the run.
    if (born.size() > kManyBorn) std::vector<NewBody>{}.swap(born);
  }
  fed_this_step = true;
}

StepSummary Simulation::State::advance() {
  const PhaseTimer::Scope scope{timer, Phase::stepper};
  return guarded(parts.stepper.info, ErrorKind::diverged,
                 [&] { return parts.stepper.plugin->step(*host, bodies.state(), time(), time_step); });
}

void Simulation::State::check_motion() const {
  const BodyView view = bodies.view();
  for (std::size_t i = 0; i < view.size(); ++i) {
    // A single comparison catches NaN as well.
    const bool sound = is_finite(view.position[i]) && is_finite(view.angular_velocity[i]) &&
                       squared_norm(view.velocity[i]) <= max_speed * max_speed;
    if (sound) continue;
    throw Error{ErrorKind::diverged,
                "body " + std::to_string(view.id[i]) + " moves at " + std::to_string(norm(view.velocity[i])) +
                    " m/s at t = " + std::to_string(time() + time_step) + " s, above simulation.max_speed = " +
                    std::to_string(max_speed) + " m/s; take a smaller time_step, or look at the forces on that body"};
  }
}

void Simulation::State::remove_bodies(double at) {
  const PhaseTimer::Scope scope{timer, Phase::sinks};
  removed.clear();
  if (parts.sinks.empty()) return;
  const BodyView view = bodies.view();
  leaving.assign(view.size(), 0);
  std::vector<char> before(view.size(), 0);
  for (const Part<Sink>& sink : parts.sinks) {
    before = leaving;
    guarded(sink.info, ErrorKind::diverged, [&] { sink.plugin->mark(view, at, leaving); });
    for (std::size_t i = 0; i < view.size(); ++i) {
      if (view.motion[i] != Motion::dynamic) leaving[i] = 0;
      if (leaving[i] == 0 || before[i] != 0) continue;
      removed.push_back(
          {view.id[i], view.material[i], view.mass[i], at, view.position[i], sink.info.name, sink.plugin->reason()});
      feed.removed[view.material[i]].add(view.mass[i]);
    }
  }
  if (!removed.empty()) bodies.remove(leaving);
}

Simulation::Simulation(const SceneDocument& document, const PluginCatalog& catalog, const SimulationSettings& settings)
    : state_{std::make_unique<State>(document, catalog, settings)} {}

Simulation::~Simulation() = default;

StepRecord Simulation::step() {
  State& s = *state_;
  s.feed_sources();
  s.backup.keep(s.bodies.view());
  StepSummary summary;
  try {
    summary = s.advance();
    s.check_motion();
  } catch (...) {
    s.backup.restore(s.bodies.state());
    s.failed = true;
    throw;
  }
  const double end = static_cast<double>(s.steps + 1) * s.time_step;
  {
    const PhaseTimer::Scope scope{s.timer, Phase::fields};
    for (const Part<ForceField>& field : s.parts.forces) {
      guarded(field.info, ErrorKind::diverged, [&] {
        field.plugin->advance(s.bodies.view(), s.parts.stepper.plugin->contacts(), s.bodies.attributes(), end,
                              s.time_step);
      });
    }
  }
  ++s.steps;
  s.fed_this_step = false;
  {
    const PhaseTimer::Scope scope{s.timer, Phase::observers};
    const Observation now = s.observation(end);
    for (const Part<Observer>& observer : s.parts.observers) {
      guarded(observer.info, ErrorKind::diverged, [&] { observer.plugin->observe(now, s.bodies.attributes()); });
    }
  }
  s.remove_bodies(end);

  StepRecord record;
  record.step = s.steps;
  record.time = end;
  record.contacts = summary.contacts;
  record.iterations = static_cast<std::uint64_t>(summary.solve.iterations);
  record.residual = summary.solve.residual;
  record.status = to_string(summary.solve.status);
  record.mean_penetration = summary.mean_penetration;
  record.max_penetration = summary.max_penetration;
  const BodyView view = s.bodies.view();
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (view.motion[i] != Motion::dynamic) continue;
    ++record.bodies;
    const Vec3 spin = rotate_back(view.orientation[i], view.angular_velocity[i]);
    record.kinetic_energy +=
        0.5 * (view.mass[i] * squared_norm(view.velocity[i]) + dot(spin, hadamard(view.inertia[i], spin)));
  }
  return record;
}

void Simulation::finish() {
  State& s = *state_;
  const PhaseTimer::Scope scope{s.timer, Phase::observers};
  const Observation last = s.observation(s.time());
  for (const Part<Observer>& observer : s.parts.observers) {
    guarded(observer.info, ErrorKind::io, [&] { observer.plugin->finish(last); });
  }
}

double Simulation::time() const { return state_->time(); }
double Simulation::end_time() const { return state_->end_time; }
double Simulation::time_step() const { return state_->time_step; }
std::uint64_t Simulation::steps() const { return state_->steps; }
// Half a step of slack: 5 s at 1 ms are 5000 steps, whatever 5000 * 0.001 rounds to.
bool Simulation::is_done() const { return state_->time() > state_->end_time - 0.5 * state_->time_step; }
std::uint64_t Simulation::state_hash() const { return state_->bodies.hash(); }
const BodyStore& Simulation::bodies() const { return state_->bodies; }
const Materials& Simulation::materials() const { return state_->model.materials; }
const FeedRecord& Simulation::feed() const { return state_->feed; }
PhaseTimer& Simulation::timer() { return state_->timer; }
const std::vector<RemovedBody>& Simulation::removed() const { return state_->removed; }
const std::vector<std::string>& Simulation::log() const { return state_->log; }
std::int64_t Simulation::steps_every() const { return state_->model.output.integer("steps_every"); }
double Simulation::checkpoint_interval() const { return state_->model.output.number("checkpoint_interval"); }
std::uint64_t Simulation::seed() const { return static_cast<std::uint64_t>(state_->model.simulation.integer("seed")); }

std::vector<ReportTable> Simulation::report() const {
  std::vector<ReportTable> tables;
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
