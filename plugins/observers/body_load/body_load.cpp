#include "body_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/figure.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/results/result_claims.hpp"
#include "scree/results/result_folder.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

namespace {

// Columns of the table.
constexpr std::size_t kTime = 0, kBody = 1, kForce = 3, kAxial = 9, kPower = 10;

std::vector<SeriesColumn> columns(const std::vector<std::string>& names) {
  return {{"time", "s"},       {"body", "", names},     {"contacts"},        {"force_x", "N"},
          {"force_y", "N"},    {"force_z", "N"},        {"torque_x", "N m"}, {"torque_y", "N m"},
          {"torque_z", "N m"}, {"axial_torque", "N m"}, {"power", "W"},      {"work", "J"}};
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

}  // namespace

BodyLoad::BodyLoad(const Options& options) : options_{options}, interval_{options.number("interval")} {
  if (options.has("axis") && norm(options.vector("axis")) == 0.0) {
    throw options.error("axis", "has no length; give a direction, such as [0, 0, 1]");
  }
}

std::vector<Parameter> BodyLoad::parameters() {
  return {
      Parameter::texts("bodies", "names of the scene bodies whose loads are wanted").with_at_least_count(1),
      Parameter::number("interval", "s", "simulated time that a row averages over; 0: every step")
          .at_least(0.0)
          .by_default(0.01),
      Parameter::vector("point", "m", "torques are about it, in the world; each body's centre of mass when left out")
          .optional(),
      Parameter::vector("axis", "1",
                        "direction of the axial torque, in the world; each body's axis of rotation when left out")
          .optional()};
}

void BodyLoad::setup(SceneServices& services, const std::filesystem::path& results) {
  followed_.setup(options_, "bodies", services);
  followed_state_.assign(followed_.size(), {});
  motions_.resize(followed_.size());
  every_ = steps_between(interval_, services.time_step());
  stem_ = result_stem("body_load", "body_load", services.part_name());
  claim_results(services, stem_,
                {".csv", "_force.svg", "_force.png", "_torque.svg", "_torque.png", "_power.svg", "_power.png"});
  results_ = results;
  table_ = SeriesTable{columns(followed_.names())};
  if (!results.empty()) table_.open(results / (stem_ + ".csv"));
}

// Of a body that is met first: its velocity without what contacts gave it in this step. A step of other forces is left out.
Twist BodyLoad::velocity_before(const Observation& now, BodyIndex body) const {
  const BodyView& bodies = now.bodies;
  const Pose pose = pose_at_contacts(bodies, body, now.contacts.age);
  Vec3 impulse, angular;
  followed_.visit(now.contacts, [&](const BodyContact& c) {
    if (c.self != body) return;
    const WorldImpulse given = impulse_on_b(now.contacts, c.contact);
    impulse += c.sign * given.linear;
    angular += c.sign * (cross(now.contacts.contact[c.contact].point - pose.position, given.linear) + given.angular);
  });
  return {bodies.velocity[body] - inverse_mass(bodies, body) * impulse,
          bodies.angular_velocity[body] - inverse_inertia(bodies, body) * angular};
}

// Velocities are means over the step, so that work is exactly what changes the kinetic energy of a free body. What moves as told
// has the same velocity from the beginning to the end.
void BodyLoad::find_motions(const Observation& now) {
  const BodyView& bodies = now.bodies;
  followed_.locate(bodies);
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    Followed& state = followed_state_[k];
    const BodyIndex i = followed_.index(k);
    if (i == FollowedBodies::kGone) {
      if (state.left < 0.0) state.left = now.time;
      continue;
    }
    const Twist velocity{bodies.velocity[i], bodies.angular_velocity[i]};
    const bool free = bodies.motion[i] == Motion::dynamic;
    if (free && !state.seen) state.velocity = velocity_before(now, i);
    const double spin = norm(velocity.angular);
    if (spin > 0.0) state.axis = velocity.angular / spin;
    BodyMotion& motion = motions_[k];
    motion.pose = pose_at_contacts(bodies, i, now.contacts.age);
    motion.velocity =
        free ? Twist{0.5 * (velocity.linear + state.velocity.linear), 0.5 * (velocity.angular + state.velocity.angular)}
             : velocity;
    motion.surface = surface_motion(bodies, i);
    motion.reference = options_.has("point") ? options_.vector("point") : motion.pose.position;
    motion.axis = options_.has("axis") ? normalized(options_.vector("axis")) : state.axis;
    state.velocity = velocity;
    state.seen = true;
  }
}

// In many short steps a body turns: what the stepper has summed up is then nearer than impulses at the last pose.
void BodyLoad::add_summed(const Observation& now) {
  summed_.assign(followed_.size(), 0);
  for (const ContactLoad& load : now.contacts.loads) {
    const std::uint32_t slot = followed_.slot(load.body);
    if (slot == FollowedBodies::kNone) continue;
    summed_[slot] = 1;
    const BodyMotion& motion = motions_[slot];
    const bool moves = now.bodies.motion[load.body] != Motion::fixed;
    const double back = moves ? 0.5 * now.dt : 0.0;
    // The body's own centre stays the reference where no other is asked for.
    const Vec3 centre =
        options_.has("point") ? now.bodies.position[load.body] - back * motion.velocity.linear : motion.reference;
    followed_state_[slot].interval.add(load_of(motion, centre, load));
  }
}

void BodyLoad::observe(const Observation& now, Attributes&) {
  find_motions(now);
  add_summed(now);
  followed_.visit(now.contacts, [&](const BodyContact& c) {
    if (now.contacts.impulse[c.contact] == Vec3{}) return;
    if (summed_[c.slot] != 0) {
      followed_state_[c.slot].interval.contacts += 1.0;
      return;
    }
    WorldImpulse impulse = impulse_on_b(now.contacts, c.contact);
    impulse.linear *= c.sign;
    impulse.angular *= c.sign;
    followed_state_[c.slot].interval.add(load_of(motions_[c.slot], now.contacts.contact[c.contact].point, impulse));
  });
  for (Followed& state : followed_state_) {
    state.interval.steps += 1.0;
    state.interval.time += now.dt;
  }
  if (now.step % every_ == 0) end_interval(now.time);
}

void BodyLoad::end_interval(double time) {
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    Followed& state = followed_state_[k];
    if (state.interval.steps == 0.0) continue;
    const LoadSum& sum = state.interval;
    const double rate = 1.0 / sum.time;
    const Vec3 force = rate * sum.impulse, torque = rate * sum.angular_impulse;
    state.total.add(sum);
    state.peak_force = std::max(state.peak_force, norm(force));
    state.peak_torque = std::max(state.peak_torque, norm(torque));
    table_.add(std::array{time, static_cast<double>(k), sum.contacts / sum.steps, force.x, force.y, force.z, torque.x,
                          torque.y, torque.z, rate * sum.axial_impulse, rate * sum.work, state.total.work});
    state.interval = {};
  }
}

void BodyLoad::finish(const Observation& last) {
  end_interval(last.time);
  table_.close();
  if (!results_.empty() && table_.rows() > 0) write_figures();
}

void BodyLoad::write_figures() const {
  plot::Figure force, torque, power;
  force.title = "Force of contacts on bodies", torque.title = "Torque of contacts about the axis";
  power.title = "Power that contacts give to bodies";
  power.note = "negative: the body gives it";
  force.y = {"force [N]"}, torque.y = {"torque [N m]"}, power.y = {"power [W]"};
  for (plot::Figure* figure : {&force, &torque, &power}) figure->x = {"time [s]"};
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const auto values = [&](std::size_t column) { return table_.column(column, kBody, static_cast<double>(k)); };
    const std::vector<double> time = values(kTime), y = values(kForce + 1), z = values(kForce + 2);
    std::vector<double> size = values(kForce);
    for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::hypot(size[i], y[i], z[i]);
    force.series.push_back({followed_.name(k), plot::SeriesStyle::line, time, size});
    torque.series.push_back({followed_.name(k), plot::SeriesStyle::line, time, values(kAxial)});
    power.series.push_back({followed_.name(k), plot::SeriesStyle::line, time, values(kPower)});
  }
  plot::write_figure(force, results_ / (stem_ + "_force"));
  plot::write_figure(torque, results_ / (stem_ + "_torque"));
  plot::write_figure(power, results_ / (stem_ + "_power"));
}

std::vector<ReportTable> BodyLoad::report() const {
  ReportTable table;
  table.title = stem_ + ": loads by contacts, means of the run";
  table.header = {"body",           "force_x [N]",        "force_y [N]",       "force_z [N]",
                  "peak force [N]", "axial torque [N m]", "peak torque [N m]", "power [W]",
                  "work [J]",       "contacts",           "left at [s]"};
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const Followed& state = followed_state_[k];
    const double rate = state.total.time > 0.0 ? 1.0 / state.total.time : 0.0;
    const Vec3 force = rate * state.total.impulse;
    table.rows.push_back({followed_.name(k), number(force.x), number(force.y), number(force.z),
                          number(state.peak_force), number(rate * state.total.axial_impulse), number(state.peak_torque),
                          number(rate * state.total.work), number(state.total.work),
                          number(state.total.contacts / std::max(1.0, state.total.steps)),
                          state.left < 0.0 ? "" : number(state.left)});
  }
  return {table};
}

void BodyLoad::save(StateWriter& out) const {
  table_.save(*out.group("table"));
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    const Followed& state = followed_state_[k];
    const auto group = out.group("body_" + std::to_string(k));
    state.interval.save(*group->group("interval"));
    state.total.save(*group->group("total"));
    group->write("motion",
                 std::span<const Vec3>{std::array{state.velocity.linear, state.velocity.angular, state.axis}});
    group->write("marks", std::span<const double>{
                              std::array{state.seen ? 1.0 : 0.0, state.peak_force, state.peak_torque, state.left}});
  }
}

void BodyLoad::load(const StateReader& in) {
  table_.load(*in.group("table"));
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    Followed& state = followed_state_[k];
    const auto group = in.group("body_" + std::to_string(k));
    state.interval.load(*group->group("interval"));
    state.total.load(*group->group("total"));
    const std::vector<Vec3> motion = group->vectors("motion");
    const std::vector<double> marks = group->doubles("marks");
    state.velocity = {motion.at(0), motion.at(1)};
    state.axis = motion.at(2);
    state.seen = marks.at(0) != 0.0;
    state.peak_force = marks.at(1);
    state.peak_torque = marks.at(2);
    state.left = marks.at(3);
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::Observer, scree::BodyLoad>(
      "body_load", "Force, torque and power that contacts give to named bodies, as table and figures.",
      scree::BodyLoad::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("body_load", "1.0.0", &list)};
