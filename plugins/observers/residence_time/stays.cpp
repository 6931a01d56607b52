#include "stays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree {

std::array<double, Stays::Followed::kNumbers> Stays::Followed::numbers() const {
  return {place.x, place.y, place.z, inside ? 1.0 : 0.0, entered, mass, static_cast<double>(material)};
}

Stays::Followed Stays::Followed::of(std::span<const double> n) {
  return {{n[0], n[1], n[2]}, n[3] != 0.0, n[4], n[5], static_cast<std::uint32_t>(n[6])};
}

void Stays::end(BodyId id, const Followed& body, double left, std::vector<Stay>& ended) {
  if (std::isfinite(body.entered)) ended.push_back({id, body.material, body.mass, body.entered, left});
}

void Stays::step(BodyId id, Followed& body, const Vec3& place, const Observation& now, std::vector<Stay>& ended) const {
  if (region_.everywhere()) return;
  const double begin = now.time - now.dt;
  const auto part = part_inside(region_.box(), body.place, place);
  const bool inside = holds(place);
  if (!body.inside && part) body.entered = begin + part->first * now.dt;
  if ((body.inside || part) && !inside) end(id, body, begin + (part ? part->second : 0.0) * now.dt, ended);
  body.inside = inside;
  body.place = place;
}

void Stays::look(const Observation& now, std::vector<Stay>& ended) {
  region_.update(now.bodies);
  hold_up_ = {};
  const auto seen = [&](BodyIndex i, Followed& body, bool is_new) {
    const Vec3 place = region_.local(now.bodies.position[i]);
    if (is_new) {
      // It was born at the begin of this step, where its velocity says.
      body.place = region_.local(now.bodies.position[i] - now.dt * now.bodies.velocity[i]);
      body.inside = holds(body.place);
      body.mass = now.bodies.mass[i];
      body.material = now.bodies.material[i];
      const bool counts = count_initial_ || !first_look_;
      body.entered = counts ? now.time - now.dt : std::numeric_limits<double>::quiet_NaN();
    }
    step(now.bodies.id[i], body, place, now, ended);
    if (!body.inside) return;
    ++hold_up_.number;
    hold_up_.mass += body.mass;
    if (std::isfinite(body.entered)) hold_up_.oldest = std::max(hold_up_.oldest, now.time - body.entered);
  };
  // What is gone was taken out at the end of the step before.
  const auto gone = [&](BodyId id, const Followed& body) {
    if (body.inside) end(id, body, now.time - now.dt, ended);
  };
  bodies_.walk(now.bodies, seen, gone);
  first_look_ = false;
}

void Stays::save(StateWriter& out) const {
  bodies_.save(out);
  out.write("first_look", std::uint64_t{first_look_ ? 1u : 0u});
  out.write("hold_up_number", hold_up_.number);
  out.write("hold_up", std::vector<double>{hold_up_.mass, hold_up_.oldest});
}

void Stays::load(const StateReader& in) {
  bodies_.load(in);
  first_look_ = in.integer("first_look") != 0;
  const std::vector<double> hold_up = in.doubles("hold_up");
  hold_up_ = {in.integer("hold_up_number"), hold_up.at(0), hold_up.at(1)};
}

}  // namespace scree
