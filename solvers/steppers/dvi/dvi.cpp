#include "dvi.hpp"

#include <algorithm>
#include <functional>

#include "rotation.hpp"
#include "scree/base/release.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/state/state_io.hpp"
#include "second_look.hpp"
#include "surface_motion.hpp"

namespace scree {

namespace {

constexpr std::size_t kGrain = 2048;

/// Calls visit(k) for each k below `count`, several at a time.
template <class Visit>
void for_each_of(std::size_t count, const Executor& executor, const Visit& visit) {
  const auto several = [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) visit(k);
  };
  executor.for_chunks(count, kGrain, std::cref(several));
}

}  // namespace

Dvi::Dvi(const Options& options)
    : Dvi{DviOptions{.limits = {options.number("recovery_speed"), options.number("min_bounce_speed")},
                     .coulomb = options.text("friction") == "coulomb",
                     .coulomb_limits = {.tolerance = options.number("friction_tolerance"),
                                        .max_solves = static_cast<int>(options.integer("friction_solves"))},
                     .gyroscopic = options.boolean("gyroscopic"),
                     .warm_start = options.boolean("warm_start")}} {}

std::vector<Parameter> Dvi::parameters() {
  return {
      Parameter::number("recovery_speed", "m/s", "greatest speed at which overlap is undone")
          .by_default(0.15)
          .at_least(0.0),
      Parameter::number("min_bounce_speed", "m/s", "impacts slower than this do not bounce")
          .by_default(0.1)
          .at_least(0.0),
      Parameter::choice("friction", {"associated", "coulomb"},
                        "convex relaxation (sliding contacts float by mu h |u_t|), or exact Coulomb friction")
          .by_default("associated"),
      Parameter::number("friction_tolerance", "m/s", "coulomb: error of the sliding speed times mu to stop at")
          .by_default(1e-3)
          .above(0.0),
      Parameter::integer("friction_solves", "coulomb: greatest number of CCPs solved in a step")
          .by_default(50)
          .at_least(1.0),
      Parameter::boolean("gyroscopic", "gyroscopic torque of bodies whose moments of inertia differ").by_default(false),
      Parameter::boolean("warm_start", "start the solver from the impulses of the last step").by_default(true),
  };
}

StepSummary Dvi::step(StepServices& services, const BodyState& bodies, double time, double dt) {
  if (impulse_.size() >= kManyRecords) release(impulse_, before_, after_, angular_impulse_);
  step_dt_ = dt;
  free_motion(services, bodies.view, time, dt);
  std::span<const Contact> found = find_contacts(services, bodies.view, dt);
  const dvi::JoinedBodies joined = pose_joints(services.machine(), bodies.view, time, dt);
  joint_guess_ = joined.problem.guess;
  StepSummary summary;
  const auto build_and_solve = [&](StepSummary& of) {
    assembly_.build({bodies.view, velocity_, angular_velocity_}, found, services.materials(), options_.limits, dt,
                    services.executor(), joined);
    solve(services, bodies.view, of, dt);
  };
  build_and_solve(summary);
  if (look_again(services, bodies.view, found, dt)) {
    found = seen_;
    StepSummary second;
    build_and_solve(second);
    second.solve.iterations += summary.solve.iterations;
    if (options_.coulomb) second.friction_solves += summary.friction_solves;
    summary = second;
  }
  finish(services, bodies.view, summary, dt);
  services.before_motion();
  move(bodies, services.executor(), dt);
  if (velocity_.size() >= kManyRecords) release(velocity_, angular_velocity_);
  return summary;
}

void Dvi::free_motion(StepServices& services, const BodyView& bodies, double time, double dt) {
  const std::size_t n = bodies.size();
  force_.resize(n);
  torque_.resize(n);
  velocity_.resize(n);
  angular_velocity_.resize(n);
  services.forces(bodies, time, {force_, torque_});
  services.executor().for_chunks(n, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      velocity_[i] = bodies.velocity[i];
      angular_velocity_[i] = bodies.angular_velocity[i];
      if (bodies.motion[i] != Motion::dynamic) continue;
      const Quat& q = bodies.orientation[i];
      const Vec3 j = bodies.inertia[i];
      velocity_[i] += (dt / bodies.mass[i]) * force_[i];
      if (torque_[i] != Vec3{}) {
        const Vec3 t = rotate_back(q, torque_[i]);
        angular_velocity_[i] += rotate(q, dt * Vec3{t.x / j.x, t.y / j.y, t.z / j.z});
      }
    }
  });
  if (n >= kManyRecords) release(force_, torque_);
}

// Surfaces that slip float by what they slip in a step, whoever moves: collision looks as far as for bodies that move so.
std::span<const Contact> Dvi::find_contacts(StepServices& services, const BodyView& bodies, double dt) {
  if (bodies.surface_motion.empty()) return services.contacts(bodies, velocity_, angular_velocity_, dt);
  surface_velocity_ = velocity_;
  surface_spin_ = angular_velocity_;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (bodies.surface_motion[i] == Twist{}) continue;
    const Twist surface = surface_motion(bodies, i);
    surface_velocity_[i] += surface.linear;
    surface_spin_[i] += surface.angular;
  }
  return services.contacts(bodies, surface_velocity_, surface_spin_, dt);
}

// What the solver has just found is known to nobody who looked for contacts before.
bool Dvi::look_again(StepServices& services, const BodyView& bodies, std::span<const Contact> found, double dt) {
  const std::span<const Twist> w = std::span<const Twist>{w_}.first(assembly_.bodies().size());
  dvi::find_struck(bodies, assembly_.bodies(), w, dt, struck_);
  if (struck_.empty()) return false;
  struck_velocity_ = velocity_;
  struck_spin_ = angular_velocity_;
  for (std::size_t k = 0; k < w.size(); ++k) {
    struck_velocity_[assembly_.bodies()[k]] += w[k].linear;
    struck_spin_[assembly_.bodies()[k]] += w[k].angular;
  }
  const std::span<const Contact> walls = services.wall_contacts(bodies, struck_, struck_velocity_, struck_spin_, dt);
  seen_.assign(found.begin(), found.end());
  return dvi::add_crossed(bodies, walls, {struck_velocity_, struck_spin_}, dt, seen_);
}

dvi::JoinedBodies Dvi::pose_joints(Machine* machine, const BodyView& bodies, double time, double dt) {
  if (machine == nullptr || machine->empty()) return {};
  motion_ = [this, &bodies, dt](BodyIndex i, const Twist& v) { return free_step(bodies, i, v, dt).pose; };
  machine->locate(bodies);
  joined_.clear();
  for (const BodyIndex i : machine->bodies()) joined_.push_back({velocity_[i], angular_velocity_[i]});
  machine->pose(bodies, joined_, motion_, {.time = time, .drift = dt, .kick = dt});
  return {machine->bodies(), machine->problem()};
}

// What the solver left in the joints, and their curved ways: after body_velocities(), whose w_ it corrects.
void Dvi::settle_joints(Machine& machine) {
  const std::span<const BodyIndex> bodies = machine.bodies();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Twist& w = w_[assembly_.number(bodies[k])];
    joined_[k] = {velocity_[bodies[k]] + w.linear, angular_velocity_[bodies[k]] + w.angular};
  }
  machine.settle(std::span{gamma_}.subspan(assembly_.first_joint_row()), joined_, motion_);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Twist& w = w_[assembly_.number(bodies[k])];
    w = {joined_[k].linear - velocity_[bodies[k]], joined_[k].angular - angular_velocity_[bodies[k]]};
  }
}

void Dvi::find_keys(const BodyView& bodies, const Executor& executor) {
  const std::span<const Contact> contacts = assembly_.contacts();
  keys_.resize(contacts.size());
  for_each_of(contacts.size(), executor, [&](std::size_t k) { keys_[k] = contact_key(bodies, contacts[k]); });
}

void Dvi::recall(const BodyView& bodies, const CcpProblem& problem, const Executor& executor, double dt) {
  gamma_.assign(problem.rows(), 0.0);
  if (options_.warm_start) {
    std::ranges::copy(joint_guess_, gamma_.begin() + static_cast<std::ptrdiff_t>(assembly_.first_joint_row()));
  }
  if (!options_.warm_start || memory_.size() == 0) return;
  find_keys(bodies, executor);
  const std::size_t m = keys_.size();
  world_impulse_.resize(m);
  world_angular_impulse_.resize(assembly_.rolls() ? m : 0);
  memory_.recall(keys_, world_impulse_, world_angular_impulse_);
  // A resting contact's impulse goes with the step.
  const double scale = dt / memory_dt_;
  for_each_of(m, executor, [&](std::size_t k) {
    const CcpContact& c = assembly_.geometry(k);
    const std::span<double> rows = std::span{gamma_}.subspan(assembly_.first_row(k));
    store_block(rows, 0, in_frame(c, scale * world_impulse_[k]));
    const dvi::RollingContact* rolling = assembly_.rolling(k);
    if (rolling == nullptr) return;
    store_block(rows, 1, in_frame(c, (scale / rolling->length) * world_angular_impulse_[k]));
  });
  if (m < kManyRecords) return;
  // The solver needs the room; remember() makes them anew.
  memory_.clear();
  release(keys_, world_impulse_, world_angular_impulse_);
}

void Dvi::solve(StepServices& services, const BodyView& bodies, StepSummary& summary, double dt) {
  const CcpProblem problem = assembly_.problem();
  recall(bodies, problem, services.executor(), dt);
  if (problem.empty()) {
    w_.assign(problem.bodies(), Twist{});  // bodies whose joints are gone
    return;
  }
  if (options_.coulomb) {
    CoulombLimits limits = options_.coulomb_limits;
    limits.solver_has_its_own_goal = true;
    const InnerSolve by_scene = [&services](const CcpProblem& posed, const InnerGoal&, std::span<double> gamma) {
      return services.solve_ccp(posed, gamma);
    };
    const CoulombSummary outer = coulomb_.solve(problem, services.executor(), by_scene, limits, gamma_);
    summary.solve = outer.solve;
    summary.friction_solves = outer.solves;
    summary.friction_error = outer.error;
  } else {
    summary.solve = services.solve_ccp(problem, gamma_);
  }
  delassus_.bind(problem, &services.executor());
  w_.resize(problem.bodies());
  delassus_.body_velocities(gamma_, w_);
  if (problem.contacts.size() >= kManyRecords) delassus_ = {};
}

// Makes the solver's answer the motion of the step, and tells of it.
void Dvi::finish(StepServices& services, const BodyView& bodies, StepSummary& summary, double dt) {
  const CcpProblem problem = assembly_.problem();
  summary.contacts = assembly_.contacts().size();
  measure_overlap(bodies, summary);
  // Also when all joints are gone, so that the machine says so.
  if (Machine* machine = services.machine(); machine != nullptr && !machine->empty()) settle_joints(*machine);
  keep_results(bodies, services.executor());
  remember(bodies, services.executor(), dt);
  summary.work =
      dvi::step_work({bodies, velocity_, angular_velocity_}, assembly_,
                     {std::span{w_}.first(problem.bodies()), impulse_, angular_impulse_}, services.executor(), work_);
  if (const Machine* machine = services.machine()) summary.work.joint_work = machine->work();
  for (std::size_t k = 0; k < problem.bodies(); ++k) {
    const BodyIndex body = assembly_.bodies()[k];
    velocity_[body] += w_[k].linear;
    angular_velocity_[body] += w_[k].angular;
  }
  if (problem.units() >= kManyRecords) release_step();
}

// While velocity_ is still that of the free motion.
void Dvi::keep_results(const BodyView& bodies, const Executor& executor) {
  const std::size_t m = assembly_.contacts().size();
  impulse_.resize(m);
  before_.resize(m);
  after_.resize(m);
  angular_impulse_.assign(assembly_.rolls() ? m : 0, Vec3{});
  const auto free = [&](std::uint32_t number) {
    const BodyIndex body = assembly_.bodies()[number];
    return Twist{velocity_[body], angular_velocity_[body]};
  };
  for_each_of(m, executor, [&](std::size_t k) {
    const CcpContact& c = assembly_.geometry(k);
    const std::span<const double> rows = std::span<const double>{gamma_}.subspan(assembly_.first_row(k));
    impulse_[k] = load_block(rows, 0);
    before_[k] = relative_velocity(c, free(c.a), free(c.b)) + dvi::surface_slip(bodies, assembly_.contacts()[k], c);
    after_[k] = before_[k] + relative_velocity(c, w_[c.a], w_[c.b]);
    const dvi::RollingContact* rolling = assembly_.rolling(k);
    if (rolling != nullptr) angular_impulse_[k] = rolling->length * load_block(rows, 1);
  });
}

void Dvi::remember(const BodyView& bodies, const Executor& executor, double dt) {
  if (!options_.warm_start) return;
  find_keys(bodies, executor);
  const std::size_t m = keys_.size();
  world_impulse_.resize(m);
  world_angular_impulse_.resize(angular_impulse_.size());
  for_each_of(m, executor, [&](std::size_t k) {
    const CcpContact& c = assembly_.geometry(k);
    world_impulse_[k] = in_world(c, impulse_[k]);
    if (!angular_impulse_.empty()) world_angular_impulse_[k] = in_world(c, angular_impulse_[k]);
  });
  memory_.store(keys_, world_impulse_, world_angular_impulse_);
  memory_dt_ = dt;
}

// Frees what nobody reads before the next step.
void Dvi::release_step() {
  assembly_.release_problem();
  delassus_ = {};
  coulomb_ = {};
  release(gamma_, w_, keys_, world_impulse_, world_angular_impulse_);
}

void Dvi::measure_overlap(const BodyView& bodies, StepSummary& summary) const {
  double sum = 0.0;
  std::size_t closed = 0;
  for (const Contact& c : assembly_.contacts()) {
    if (c.gap > 0.0) continue;
    sum -= c.gap / dvi::smaller_radius(bodies, c);
    summary.max_penetration = std::max(summary.max_penetration, -c.gap);
    ++closed;
  }
  summary.mean_penetration = closed > 0 ? sum / static_cast<double>(closed) : 0.0;
}

// Impulses act at the beginning of the step; from there on the body moves freely. With a gyroscopic torque that is Euler's
// motion, which keeps the angular momentum in the world.
Dvi::FreeStep Dvi::free_step(const BodyView& bodies, BodyIndex i, const Twist& velocity, double dt) const {
  const Quat& q = bodies.orientation[i];
  const Vec3 w = velocity.angular;
  FreeStep step{{bodies.position[i] + dt * velocity.linear, q}, w};
  const Vec3 j = bodies.inertia[i];
  const bool turns_evenly = bodies.motion[i] != Motion::dynamic || (j.x == j.y && j.y == j.z);
  if (options_.gyroscopic && !turns_evenly) {
    const Vec3 before = rotate_back(q, w), change = dvi::gyroscopic_change(j, before, dt);
    step.pose.orientation = dvi::turned(q, dvi::cayley_angle(dt * rotate(q, before + 0.5 * change)));
    step.angular_velocity = rotate(step.pose.orientation, before + change);
  } else if (w != Vec3{}) {
    step.pose.orientation = dvi::turned(q, dt * w);
  }
  return step;
}

void Dvi::move(const BodyState& bodies, const Executor& executor, double dt) const {
  executor.for_chunks(velocity_.size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (bodies.view.motion[i] == Motion::fixed) continue;
      const FreeStep step = free_step(bodies.view, static_cast<BodyIndex>(i), {velocity_[i], angular_velocity_[i]}, dt);
      bodies.position[i] = step.pose.position;
      bodies.orientation[i] = step.pose.orientation;
      if (bodies.view.motion[i] != Motion::dynamic) continue;
      bodies.velocity[i] = velocity_[i];
      bodies.angular_velocity[i] = step.angular_velocity;
    }
  });
}

ContactView Dvi::contacts() const {
  return {assembly_.contacts(), impulse_, before_, after_, angular_impulse_, step_dt_};
}

void Dvi::save(StateWriter& out) const {
  memory_.save(out);
  out.write("time_step", memory_dt_);
}

void Dvi::load(const StateReader& in) {
  memory_.load(in);
  memory_dt_ = in.number("time_step");
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::TimeStepper, scree::Dvi>(
      "dvi", "Non-smooth dynamics: hard contacts, large steps, one cone complementarity problem a step.",
      scree::Dvi::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("dvi", "1.0.0", &list)};
