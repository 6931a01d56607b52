#include "fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "scree/interfaces/scene_services.hpp"
#include "scree/state/state_io.hpp"

namespace scree {

std::vector<Parameter> Fill::parameters() {
  std::vector<Parameter> all{
      Parameter::integer("count", "number of particles").at_least(1),
      Parameter::vector("lower", "m", "corner of the box with the smallest coordinates"),
      Parameter::vector("upper", "m", "corner of the box with the largest coordinates"),
      Parameter::choice("up", {"x", "y", "z"}, "axis along which layers follow each other").by_default("z")};
  for (Parameter& parameter : Mixture::parameters()) all.push_back(std::move(parameter));
  return all;
}

Fill::Fill(const Options& options)
    : options_{options},
      lower_{options.vector("lower")},
      upper_{options.vector("upper")},
      count_{options.integer("count")},
      up_{options.text("up")[0] - 'x'} {
  for (int axis = 0; axis < 3; ++axis) {
    if (upper_[axis] <= lower_[axis])
      throw options.error("upper", "every coordinate of 'upper' has to exceed that of 'lower'");
  }
}

void Fill::setup(SceneServices& services) {
  mixture_.emplace(options_, services);
  shapes_ = &services.shapes();
  random_.emplace(services.random_stream("fill"));
}

void Fill::emit(const BodyView&, double, double, std::vector<NewBody>& out) {
  if (done_) return;
  done_ = true;
  std::vector<Particle> particles;
  double radius = 0.0;
  for (std::int64_t i = 0; i < count_; ++i) {
    particles.push_back(mixture_->draw(*random_));
    radius = std::max(radius, particles.back().bounding_radius);
  }
  // A lattice on which two of the largest particles just miss each other; smaller ones are moved about in their cell.
  const double cell = 2.0 * radius * (1.0 + 1e-9);
  const Vec3 room = upper_ - lower_;
  std::array<std::int64_t, 3> cells{};
  for (int axis = 0; axis < 3; ++axis)
    cells[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(room[axis] / cell));
  if (cells[0] * cells[1] * cells[2] < count_) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "the box has room for %lld particles of up to %.3g mm, but %lld are wanted; make it larger",
                  static_cast<long long>(cells[0] * cells[1] * cells[2]), 2e3 * radius, static_cast<long long>(count_));
    throw options_.error("upper", text);
  }
  const int across = (up_ + 1) % 3, along = (up_ + 2) % 3;
  const auto n = [&](int axis) { return cells[static_cast<std::size_t>(axis)]; };
  for (std::int64_t i = 0; i < count_; ++i) {
    Particle& particle = particles[static_cast<std::size_t>(i)];
    Vec3 at = lower_;
    at[across] += (static_cast<double>(i % n(across)) + 0.5) * room[across] / static_cast<double>(n(across));
    at[along] += (static_cast<double>(i / n(across) % n(along)) + 0.5) * room[along] / static_cast<double>(n(along));
    at[up_] += (static_cast<double>(i / (n(across) * n(along))) + 0.5) * cell;
    const double play = radius - particle.bounding_radius;
    for (int axis = 0; axis < 3; ++axis) at[axis] += random_->uniform(-play, play);
    particle.body.pose.position = at;
    particle.body.shape = shapes_->add(particle.shape);
    out.push_back(std::move(particle.body));
  }
}

void Fill::save(StateWriter& out) const {
  out.write("done", std::uint64_t{done_});
  out.write("random", random_->counter());
}

void Fill::load(const StateReader& in) {
  done_ = in.integer("done") != 0;
  random_->set_counter(in.integer("random"));
}

}  // namespace scree
