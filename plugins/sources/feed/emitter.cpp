#include "emitter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scree/interfaces/scene_services.hpp"
#include "scree/state/state_io.hpp"

namespace scree {
namespace {

/// Trials to place a particle before it waits for the next step.
constexpr int kTrials = 40;

}  // namespace

std::vector<Parameter> Emitter::parameters() {
  std::vector<Parameter> all{
      Parameter::number("rate", "1/s", "particles per second; this or mass_rate").at_least(0.0).optional(),
      Parameter::number("mass_rate", "kg/s", "mass per second; this or rate").at_least(0.0).optional(),
      Parameter::integer("total", "number of particles after which the feed ends").at_least(0).optional(),
      Parameter::number("start", "s", "time at which the feed begins").by_default(0.0),
      Parameter::number("stop", "s", "time at which the feed ends").optional(),
      Parameter::vector("centre", "m", "middle of the outlet"),
      Parameter::vector("u", "m", "one edge of the outlet, a rectangle"),
      Parameter::vector("v", "m", "the other edge, perpendicular to u"),
      Parameter::vector("velocity", "m/s", "of the particles at birth").by_default(Vec3{}),
      Parameter::number("velocity_spread", "m/s", "standard deviation of each component of the velocity")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("spin_spread", "rad/s", "standard deviation of each component of the angular velocity")
          .at_least(0.0)
          .by_default(0.0)};
  for (Parameter& parameter : Mixture::parameters()) all.push_back(std::move(parameter));
  return all;
}

Emitter::Emitter(const Options& options)
    : options_{options},
      start_{options.number("start")},
      centre_{options.vector("centre")},
      u_{options.vector("u")},
      v_{options.vector("v")},
      velocity_{options.vector("velocity")},
      spread_{options.number("velocity_spread")},
      spin_{options.number("spin_spread")} {
  if (options.has("rate") == options.has("mass_rate")) {
    throw options.error("an emitter needs either 'rate' (particles per second) or 'mass_rate' (mass per second)");
  }
  if (options.has("rate")) rate_ = options.number("rate");
  if (options.has("mass_rate")) mass_rate_ = options.number("mass_rate");
  if (options.has("total")) total_ = static_cast<std::uint64_t>(options.integer("total"));
  if (options.has("stop")) stop_ = options.number("stop");
  if (stop_ <= start_) throw options.error("stop", "must be later than 'start'");
  if (norm(cross(u_, v_)) <= 0.0) throw options.error("v", "and 'u', the edges of the outlet, must span a rectangle");
  if (std::abs(dot(u_, v_)) > 1e-6 * norm(u_) * norm(v_)) {
    throw options.error("v", "must be perpendicular to 'u', the other edge of the outlet");
  }
}

void Emitter::setup(SceneServices& services) {
  mixture_.emplace(options_, services);
  shapes_ = &services.shapes();
  services_ = &services;
  name_ = services.part_name();
  particles_.emplace(services.random_stream("particles"));
  places_.emplace(services.random_stream("places"));
}

double Emitter::open_until(double until) const { return std::max(0.0, std::min(until, stop_) - start_); }

double Emitter::backlog() const {
  const double open = open_until(until_), born = static_cast<double>(emitted_);
  double due = 0.0;
  if (rate_) {
    due = *rate_ * open * (1.0 + 1e-12);
  } else {
    const double mass = emitted_ > 0 ? emitted_mass_ / born : (pending_ ? pending_->body.mass : 0.0);
    due = mass > 0.0 ? *mass_rate_ * open / mass : 0.0;
  }
  return std::max(0.0, std::floor(std::min(due, static_cast<double>(total_)) - born));
}

void Emitter::tell_of_backlog(double time) {
  if (told_ || backlog() < 1.0) return;
  const double a_second = rate_ ? *rate_ : *mass_rate_ * static_cast<double>(emitted_) / emitted_mass_;
  // Not yet told when none of a mass_rate is born: nothing is known of its particles, and a_second is no number.
  if (!(backlog() > a_second)) return;
  told_ = true;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "warning: at %.4g s %.0f particles are due and find no place, more than a second of the feed; make the outlet "
      "larger or the particles faster",
      time, backlog());
  services_->log(text);
}

std::vector<ReportTable> Emitter::report() const {
  std::vector<ReportTable> tables = mixture_->report();
  if (postponed_ == 0) return tables;
  char waiting[40];
  std::snprintf(waiting, sizeof waiting, "%.0f", backlog());
  tables.push_back({"feed " + name_,
                    {"born", "steps in which one found no place", "due and not born"},
                    {{std::to_string(emitted_), std::to_string(postponed_), waiting}}});
  return tables;
}

bool Emitter::is_due(const Particle& particle, double until) const {
  // Closed in the time, not summed up step by step, so that no rounding accumulates.
  const double open = std::min(until, stop_) - start_;
  if (rate_) return static_cast<double>(emitted_ + 1) <= *rate_ * open * (1.0 + 1e-12);
  return emitted_mass_ + 0.5 * particle.body.mass <= *mass_rate_ * open;
}

Aabb Emitter::outlet(double dt) const {
  const Vec3 way = dt * velocity_;
  const Vec3 corner = centre_ - 0.5 * u_ - 0.5 * v_;
  Aabb box = Aabb::empty();
  for (const Vec3& p : {corner, corner + u_, corner + v_, corner + u_ + v_}) box = merged(merged(box, p), p + way);
  return box;
}

bool Emitter::place(Particle& particle, double dt) {
  for (int trial = 0; trial < kTrials; ++trial) {
    // Along the way of one step behind the outlet, so that the stream has no layers.
    const Vec3 at = centre_ + places_->uniform(-0.5, 0.5) * u_ + places_->uniform(-0.5, 0.5) * v_ +
                    (places_->uniform() * dt) * velocity_;
    if (!occupancy_.is_free(at, particle.bounding_radius)) continue;
    occupancy_.add(at, particle.bounding_radius);
    particle.body.pose.position = at;
    const auto scatter = [&](double deviation) {
      return deviation > 0.0 ? deviation * Vec3{places_->normal(), places_->normal(), places_->normal()} : Vec3{};
    };
    particle.body.velocity = velocity_ + scatter(spread_);
    particle.body.angular_velocity = scatter(spin_);
    return true;
  }
  return false;
}

void Emitter::emit(const BodyView& bodies, double time, double dt, std::vector<NewBody>& out) {
  until_ = time + dt;
  if (time + dt <= start_ || emitted_ >= total_) return;
  occupancy_.clear();
  double margin = -1.0;  // what was collected reaches this far around the outlet [m]
  while (emitted_ < total_) {
    if (!pending_) {
      pending_counter_ = particles_->counter();
      pending_ = mixture_->draw(*particles_);
    }
    if (!is_due(*pending_, time + dt)) return;
    if (pending_->bounding_radius > margin) {
      margin = 2.0 * pending_->bounding_radius;
      occupancy_.collect(bodies, *shapes_, expanded(outlet(dt), margin));
    }
    if (!place(*pending_, dt)) {
      ++postponed_;
      tell_of_backlog(time);
      return;
    }
    ++emitted_;
    emitted_mass_ += pending_->body.mass;
    out.push_back(to_body(std::move(*pending_), *shapes_));
    pending_.reset();
  }
}

void Emitter::save(StateWriter& out) const {
  out.write("particles", pending_ ? pending_counter_ : particles_->counter());
  out.write("places", places_->counter());
  out.write("emitted", emitted_);
  out.write("emitted_mass", emitted_mass_);
  out.write("postponed", postponed_);
}

void Emitter::load(const StateReader& in) {
  pending_.reset();
  particles_->set_counter(in.integer("particles"));
  places_->set_counter(in.integer("places"));
  emitted_ = in.integer("emitted");
  emitted_mass_ = in.number("emitted_mass");
  postponed_ = in.integer("postponed");
}

}  // namespace scree
