#include "dem.hpp"
#include "four.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "scree/base/error.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/model/material.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/state/state_io.hpp"
#include "sub_step_limit.hpp"

namespace scree {
namespace {

constexpr std::size_t kGrain = 4096;
/// Bodies that touch drift apart in memory as they move; after so many outer steps they are sorted again.
constexpr std::uint64_t kStepsBetweenSorts = 100;
/// Part of the smallest radius. A settled bed of 64 000 takes 1.1 to 1.4 times as long with a half, a quarter or twice of it.
constexpr double kSkin = 0.2;
/// Mean overlap over the radius at which a law is too soft to mean anything.
constexpr double kDeep = 0.05;

double mean_overlap(const dem::ContactTally& tally) {
  return tally.closed > 0 ? tally.relative_overlap / static_cast<double>(tally.closed) : 0.0;
}

}  // namespace

Dem::Dem(const Options& options)
    : Dem{DemOptions{.sub_step = options.number("sub_step"),
                     .force_step = options.boolean("force_step"),
                     .skin = options.number("skin"),
                     .at_contact_point = options.text("lever") == "contact_point"}} {
  scene_options_ = options;
}

std::vector<Parameter> Dem::parameters() {
  return {
      Parameter::number("sub_step", "s",
                        "step of the integration, made a whole part of the outer one; 0: as long as stable")
          .by_default(0.0)
          .at_least(0.0),
      Parameter::boolean("force_step", "take sub_step even where the contact law calls it too long").by_default(false),
      Parameter::number("skin", "m", "pairs nearer than this are neighbours; 0: a fifth of the smallest radius")
          .by_default(0.0)
          .at_least(0.0),
      Parameter::choice("lever", {"radius", "contact_point"},
                        "forces act at each body's undeformed surface, or midway between the two surfaces, which keeps "
                        "the angular momentum exactly")
          .by_default("radius"),
  };
}

void Dem::setup(SceneServices& services) { scene_ = &services; }

StepSummary Dem::step(StepServices& services, const BodyState& bodies, double time, double dt) {
  const ContactLaw* law = services.contact_law();
  if (law == nullptr) throw Error{ErrorKind::usage, "time_stepper:dem needs a [contact_law]"};
  const Call call{services, bodies, *law, time, dt};
  take_over(call);
  choose_sub_step(call);
  const bool steady = services.forces_are_steady();
  unstored_ = dt;
  dem::Motions work;
  dem::ContactTally tally;
  for (std::size_t k = 0; k <= sub_steps_; ++k) {
    const dem::Stage stage = k == 0 ? dem::Stage::first : k == sub_steps_ ? dem::Stage::last : dem::Stage::middle;
    if (k == 0 || !steady) ask_fields(call, time + static_cast<double>(k) * h_);
    const double greatest = tally.greatest_overlap;
    tally = ask_contacts(call, stage);
    tally.greatest_overlap = std::max(tally.greatest_overlap, greatest);
    work.boundary_work += tally.belt_work;
    const bool drifts = stage != dem::Stage::last;
    if (!joints_.empty()) joints_.before(slots_, bodies, stage);
    dem::Motions moved = verlet_.advance(slots_, h_, stage, services.executor());
    if (!joints_.empty()) joints_.after(slots_, bodies.view, time + static_cast<double>(k) * h_, h_, stage, moved);
    work.contact_work += moved.contact_work;
    work.boundary_work += moved.boundary_work;
    work.force_work += moved.force_work;
    if (drifts) watch_drift(call, h_ * moved.fastest);
  }
  slots_.store(bodies, unstored_, services.executor());
  StepSummary summary;
  keep_results(call, tally, work, summary);
  last_h_ = h_;
  ++steps_since_sort_;
  return summary;
}

/// Makes the columns those of the bodies of this step.
void Dem::take_over(const Call& call) {
  const BodyView& bodies = call.bodies.view;
  report_is_due_ = false;
  balls_.set_layout(call.law.history_size(), call.law.resists_rolling());
  const bool same = std::ranges::equal(ids_, bodies.id);
  if (!same || slots_.size() != bodies.size()) follow_bodies(bodies);
  if (!same || slots_.slot_of.size() != bodies.size() || steps_since_sort_ >= kStepsBetweenSorts) {
    slots_.sort(bodies);
    drift_.forget();
    steps_since_sort_ = 0;
    list_is_good_ = false;
  }
  joints_.begin_step(call.services.machine(), bodies);
  const std::vector<dem::Flat> old_flats = slots_.flats;
  slots_.load(bodies, scene_->shapes(), joints_.bodies(), call.services.executor());
  list_is_good_ &= std::ranges::equal(old_flats, slots_.flats, {}, &dem::Flat::slot, &dem::Flat::slot);
  refuse_moving_surfaces_of_balls(bodies);
  balls_.begin_step(call.services.executor());
  shapes_.begin_step(bodies);
  if (std::exchange(filter_version_, call.services.filter_version()) != call.services.filter_version())
    list_is_good_ = false;
  if (!list_is_good_) find_neighbours(call);
}

/// Contacts of two balls do not know of surfaces that move against their bodies.
void Dem::refuse_moving_surfaces_of_balls(const BodyView& bodies) const {
  for (BodyIndex i = 0; i < bodies.surface_motion.size(); ++i) {
    if (slots_.place[slots_.slot_of[i]].radius == 0.0 || bodies.surface_motion[i] == Twist{}) continue;
    throw Error{ErrorKind::usage,
                "time_stepper:dem: body " + std::to_string(bodies.id[i]) +
                    " is a ball whose surface moves against it, which dem does not know; give it another "
                    "shape, such as a capsule, or turn the body itself"};
  }
}

/// Tells what is kept of contacts which bodies are still there.
void Dem::follow_bodies(const BodyView& bodies) {
  std::vector<BodyIndex> index(ids_.size(), dem::BallContacts::kGone);
  for (std::size_t old = 0, now = 0; old < ids_.size(); ++old) {
    while (now < bodies.size() && bodies.id[now] < ids_[old]) ++now;
    if (now < bodies.size() && bodies.id[now] == ids_[old]) index[old] = static_cast<BodyIndex>(now);
  }
  balls_.renumber(index);
  ids_.assign(bodies.id.begin(), bodies.id.end());
}

/// What the bodies of a material ask of a time step.
struct Dem::Extremes {
  void add(const Extremes& o) {
    mass = std::min(mass, o.mass), radius = std::min(radius, o.radius);
    standing_radius = std::min(standing_radius, o.standing_radius);
    speed = std::max(speed, o.speed);
    moves |= o.moves, stands |= o.stands;
  }

  double mass = std::numeric_limits<double>::infinity();             // smallest of those that move [kg]
  double radius = std::numeric_limits<double>::infinity();           // the same [m]
  double standing_radius = std::numeric_limits<double>::infinity();  // of balls that do not move by forces [m]
  double speed = 0.0;                                                // greatest of a surface [m/s]
  bool moves = false, stands = false;
};

Dem::Extremes Dem::extremes_of(const BodyView& bodies, BodyIndex body) const {
  const double ball = slots_.place[slots_.slot_of[body]].radius;
  Extremes e{.speed = norm(bodies.velocity[body]) + ball * norm(bodies.angular_velocity[body])};
  if (bodies.motion[body] == Motion::dynamic) {
    e.moves = true;
    e.mass = bodies.mass[body], e.radius = bodies.radius[body];
  } else {
    e.stands = true;
    if (ball > 0.0) e.standing_radius = ball;
  }
  return e;
}

std::vector<Dem::Extremes> Dem::extremes(const Call& call) const {
  const BodyView& bodies = call.bodies.view;
  const std::size_t materials = call.services.materials().size();
  std::vector<Extremes> parts(materials * Executor::chunk_count(bodies.size(), kGrain));
  call.services.executor().for_chunks(bodies.size(), kGrain, [&](std::size_t first, std::size_t last) {
    Extremes* const of = parts.data() + first / kGrain * materials;
    for (std::size_t i = first; i < last; ++i)
      of[bodies.material[i]].add(extremes_of(bodies, static_cast<BodyIndex>(i)));
  });
  std::vector<Extremes> of(materials);
  for (std::size_t k = 0; k < parts.size(); ++k) of[k % materials].add(parts[k]);
  for (std::size_t k = 0; k < slots_.turning.size(); ++k) {
    const BodyIndex i = slots_.body[slots_.turning[k].slot];
    Extremes& e = of[bodies.material[i]];
    e.speed = std::max(e.speed, norm(bodies.velocity[i]) + slots_.reach[k] * norm(bodies.angular_velocity[i]));
  }
  return of;
}

double Dem::stable_step(const Call& call, std::array<std::uint32_t, 2>& stiffest) const {
  const std::vector<Extremes> of = extremes(call);
  // Several points of one pair share its mass; see ShapeContacts.
  const double share = 1.0 / static_cast<double>(shapes_.most_points());
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t a = 0; a < of.size(); ++a) {
    if (!of[a].moves) continue;
    for (std::uint32_t b = 0; b < of.size(); ++b) {
      const auto ask = [&](double mass, double radius) {
        const double step = call.law.stable_step({a, b, share * mass, radius, of[a].speed + of[b].speed});
        if (step < least) least = step, stiffest = {a, b};
      };
      if (of[b].moves) {
        ask(1.0 / (1.0 / of[a].mass + 1.0 / of[b].mass), 1.0 / (1.0 / of[a].radius + 1.0 / of[b].radius));
      }
      if (of[b].stands) ask(of[a].mass, 1.0 / (1.0 / of[a].radius + 1.0 / of[b].standing_radius));
    }
  }
  return least;
}

void Dem::choose_sub_step(const Call& call) {
  std::array<std::uint32_t, 2> stiffest{};
  const double stable = stable_step(call, stiffest), asked = options_.sub_step;
  // Later, when bodies are faster or smaller than those of the first step, the step is made as short as it has to be.
  if (asked > stable * (1.0 + 1e-9) && !options_.force_step && last_h_ == 0.0) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "is %.4g s, longer than the %.4g s that the contact law calls stable for the stiffest contact; take a shorter "
        "one, 0 for that, or force_step = true",
        asked, stable);
    if (scene_options_.names().empty()) throw Error{ErrorKind::usage, std::string{"dem: sub_step "} + text};
    throw scene_options_.error("sub_step", text);
  }
  const double wanted = asked > 0.0 && (options_.force_step || asked < stable) ? asked : stable;
  const double longest = std::min(wanted, call.dt);
  const double count = std::max(1.0, std::ceil(call.dt / longest - 1e-9));
  if (!(count <= dem::kMostSubSteps)) {
    throw error_of(dem::EndlessStep{call.dt, count, wanted == asked, stiffest, last_h_ == 0.0}, scene_options_,
                   call.services.materials());
  }
  sub_steps_ = static_cast<std::size_t>(count);
  h_ = call.dt / static_cast<double>(sub_steps_);
  if (told_ || !std::isfinite(stable)) return;
  told_ = true;
  char text[240];
  std::snprintf(text, sizeof text,
                "%zu sub-steps of %.4g s in a step; the stiffest contact allows %.4g s; skin %.4g m, %zu "
                "pairs of balls in %.4g MB",
                sub_steps_, h_, stable, skin_, balls_.pairs(), 1e-6 * static_cast<double>(balls_.memory()));
  scene_->log(text);
}

void Dem::find_neighbours(const Call& call) {
  const BodyView& bodies = call.bodies.view;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] != Motion::dynamic) continue;
    least = std::min(least, bodies.radius[i]);
    most = std::max(most, bodies.radius[i]);
  }
  skin_ = options_.skin > 0.0 ? options_.skin : std::isfinite(least) ? kSkin * least : 0.0;
  reach_ = call.law.reach(most);  // against a wall the effective radius is a body's own
  drift_.begin(slots_, least, call.services.executor());
  const NeighbourView found = call.services.neighbours(bodies, drift_.expected(skin_ + reach_));
  listed_.assign(found.others.begin(), found.others.end());
  balls_.set_neighbours(slots_, found.balls, call.services.executor());
  list_is_good_ = true;
}

void Dem::ask_fields(const Call& call, double time) {
  const std::size_t n = slots_.size();
  field_force_.resize(n), field_torque_.resize(n);
  if (time > call.time) {
    slots_.store(call.bodies, h_, call.services.executor());
    unstored_ = 0.0;
  }
  call.services.forces(call.bodies.view, time, {field_force_, field_torque_});
  const bool turns = std::ranges::any_of(field_torque_, [](const Vec3& torque) { return torque != Vec3{}; });
  slots_.field_torque.resize(turns ? n : 0);
  call.services.executor().for_chunks(n, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) slots_.field_force[k] = dem::four_of(field_force_[slots_.body[k]], 0.0);
    for (std::size_t k = first; turns && k < last; ++k) slots_.field_torque[k] = field_torque_[slots_.body[k]];
  });
}

dem::ContactTally Dem::ask_contacts(const Call& call, dem::Stage stage) {
  const BodyView& bodies = call.bodies.view;
  const dem::Evaluation evaluation{.law = &call.law,
                                   .stage = stage,
                                   .h = h_,
                                   .last_h = last_h_,
                                   .reach = reach_,
                                   .materials = call.services.materials().size(),
                                   .at_contact_point = options_.at_contact_point,
                                   .history = call.law.history_size(),
                                   .rolls = call.law.resists_rolling()};
  dem::ContactTally tally = balls_.evaluate(slots_, evaluation, call.services.executor());
  if (listed_.empty() && shapes_.empty()) return tally;
  std::span<const Contact> found;
  if (!listed_.empty()) {
    slots_.store_poses(call.bodies, listed_);
    found = call.services.neighbour_contacts(bodies, evaluation.reach);
  }
  tally += shapes_.evaluate(slots_, bodies, found, evaluation, call.services.executor());
  return tally;
}

/// Two bodies that are half a skin each from where they are expected may meet.
void Dem::watch_drift(const Call& call, double way) {
  if (!drift_.exceeds(0.5 * skin_, h_, way, slots_, call.services.executor())) return;
  slots_.store_poses(call.bodies, {});
  find_neighbours(call);
}

void Dem::keep_results(const Call& call, const dem::ContactTally& tally, const dem::Motions& work,
                       StepSummary& summary) {
  shape_records_.clear();
  shapes_.report(slots_, call.bodies.view, call.law.resists_rolling(), shape_records_);
  slots_.report_loads(records_.loads);
  executor_ = &call.services.executor();
  report_is_due_ = true;
  if (mean_overlap(tally) > kDeep && !warned_) {
    warned_ = true;
    char text[200];
    std::snprintf(text, sizeof text,
                  "warning: contacts overlap by %.0f %% of the smaller radius on average at t = %.4g s; take a "
                  "stiffer contact law",
                  100.0 * mean_overlap(tally), call.time + call.dt);
    scene_->log(text);
  }
  summary.solve.status = SolveStatus::converged;
  summary.solve.iterations = static_cast<int>(sub_steps_);
  summary.contacts = tally.closed;
  summary.mean_penetration = mean_overlap(tally);
  summary.max_penetration = tally.greatest_overlap;
  summary.work = {.contact_loss = work.boundary_work - work.contact_work,
                  .boundary_work = work.boundary_work,
                  .force_work = work.force_work,
                  .joint_work = joints_.work()};
}

ContactView Dem::contacts() const {
  if (report_is_due_) {
    report_is_due_ = false;
    balls_.report(slots_, *executor_, ball_records_);
    if (shape_records_.size() == 0) {
      std::swap(ball_records_.loads, records_.loads);
      std::swap(records_, ball_records_);
    } else {
      records_.merge(ball_records_, shape_records_);
    }
  }
  return records_.view();
}

void Dem::save(StateWriter& out) const {
  std::vector<std::uint64_t> order;
  for (const BodyIndex body : slots_.body) order.push_back(ids_[body]);
  out.write("order", order);
  out.write("steps_since_sort", steps_since_sort_);
  out.write("sub_step", last_h_);
  const std::size_t history = balls_.history_size();
  out.write("history_size", std::uint64_t{history});
  out.write("rolls", std::uint64_t{balls_.rolls() ? 1U : 0U});
  out.write("most_points", std::uint64_t{shapes_.most_points()});
  balls_.save(out, ids_);
  shapes_.save(out, history);
}

void Dem::load(const StateReader& in) {
  const std::vector<std::uint64_t> order = in.integers("order");
  ids_.assign(order.begin(), order.end());
  std::ranges::sort(ids_);
  std::vector<BodyIndex> bodies;
  for (const BodyId id : order)
    bodies.push_back(static_cast<BodyIndex>(std::ranges::lower_bound(ids_, id) - ids_.begin()));
  slots_.set_order(bodies);
  steps_since_sort_ = in.integer("steps_since_sort");
  last_h_ = in.number("sub_step");
  const auto history = static_cast<std::size_t>(in.integer("history_size"));
  balls_.set_layout(history, in.integer("rolls") != 0);
  shapes_.set_most_points(static_cast<std::size_t>(in.integer("most_points")));
  balls_.load(in, ids_);
  shapes_.load(in, history);
  list_is_good_ = false;
  report_is_due_ = false;
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::TimeStepper, scree::Dem>(
      "dem", "Discrete element method: soft contacts by a [contact_law], many short Verlet steps within an outer one.",
      scree::Dem::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{scree::describe_library("dem", "1.0.0", &list)};
