#include "fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "scree/interfaces/scene_services.hpp"
#include "scree/state/state_io.hpp"

namespace scree {
namespace {

// Share of the largest radius by which a particle of mean size is to be moved about. Exact rows would stay rows: nothing ever
// moves soft grains out of a plane that gravity and all motion lie in.
constexpr double kPlay = 0.08;

}  // namespace

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
    if (upper_[axis] <= lower_[axis]) throw options.error("upper", "must exceed 'lower' in every coordinate");
  }
}

void Fill::setup(SceneServices& services) {
  mixture_.emplace(options_, services);
  shapes_ = &services.shapes();
  particles_.emplace(services.random_stream("particles"));
  places_.emplace(services.random_stream("places"));
  // Drawn here for their radii only, and again, the same ones, when they are born: no list of particles is kept.
  double sum = 0.0;
  for (std::int64_t i = 0; i < count_; ++i) {
    const double radius = mixture_->draw(*particles_).bounding_radius;
    radius_ = std::max(radius_, radius);
    sum += radius;
  }
  particles_->set_counter(0);
  mean_radius_ = sum / static_cast<double>(count_);
  lay(0.0);
  check_room(cell_count());
}

void Fill::lay(double loose) {
  reach_ = radius_ * (1.0 + loose);
  const double cell = 2.0 * reach_ * (1.0 + 1e-9);
  const Vec3 room = upper_ - lower_;
  for (int axis = 0; axis < 3; ++axis) {
    const double fits = std::floor(room[axis] / cell);
    cells_[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::min(fits, 1e6));
    pitch_[axis] = axis == up_ ? cell : room[axis] / std::max(1.0, fits);
  }
}

std::int64_t Fill::cell_count() const { return cells_[0] * cells_[1] * cells_[2]; }

void Fill::check_room(std::int64_t cells) const {
  if (cells >= count_) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "leaves room in the box for %lld particles of up to %.3g mm, but %lld are wanted; make it larger",
                static_cast<long long>(cells), 2e3 * radius_, static_cast<long long>(count_));
  throw options_.error("upper", text);
}

Vec3 Fill::middle(std::int64_t cell) const {
  Vec3 at = lower_;
  for (const int axis : {(up_ + 1) % 3, (up_ + 2) % 3, up_}) {
    const std::int64_t n = cells_[static_cast<std::size_t>(axis)];
    at[axis] += (static_cast<double>(cell % n) + 0.5) * pitch_[axis];
    cell /= n;
  }
  return at;
}

// Marks the cells that a box meets.
void Fill::take(const Aabb& box, std::unordered_set<std::int64_t>& taken) const {
  std::array<std::int64_t, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const double n = static_cast<double>(cells_[axis]);
    first[axis] = static_cast<std::int64_t>(std::clamp(std::floor((box.lower[a] - lower_[a]) / pitch_[a]), 0.0, n));
    last[axis] =
        static_cast<std::int64_t>(std::clamp(std::floor((box.upper[a] - lower_[a]) / pitch_[a]) + 1.0, 0.0, n));
  }
  const auto across = static_cast<std::size_t>((up_ + 1) % 3), along = static_cast<std::size_t>((up_ + 2) % 3);
  const auto up = static_cast<std::size_t>(up_);
  for (std::int64_t k = first[up]; k < last[up]; ++k) {
    for (std::int64_t j = first[along]; j < last[along]; ++j) {
      for (std::int64_t i = first[across]; i < last[across]; ++i) {
        taken.insert((k * cells_[along] + j) * cells_[across] + i);
      }
    }
  }
}

std::vector<std::int64_t> Fill::free_cells(const BodyView& bodies) const {
  std::unordered_set<std::int64_t> taken;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies.motion[b] != Motion::dynamic) continue;
    // Primitive by primitive: a drum of staves is hollow.
    for (const Primitive& part : shapes_->primitives(shapes_->shapes()[bodies.shape[b]])) {
      if (part.collides)
        take(bounds(*shapes_, part, Pose{bodies.position[b], bodies.orientation[b]} * part.local), taken);
    }
  }
  std::vector<std::int64_t> free;
  for (std::int64_t cell = 0; cell < cell_count() && static_cast<std::int64_t>(free.size()) < count_; ++cell) {
    if (taken.count(cell) == 0) free.push_back(cell);
  }
  return free;
}

// Where sizes differ, the smaller particles have room to be moved about in cells for the largest; where they hardly differ, the
// cells are made wider, as far as the box has room.
std::vector<std::int64_t> Fill::places(const BodyView& bodies) {
  constexpr int kTries = 8;
  const double loosest = std::max(0.0, kPlay - (1.0 - mean_radius_ / radius_));
  for (int share = kTries; share > 0; --share) {
    lay(loosest * share / kTries);
    if (cell_count() < count_) continue;
    std::vector<std::int64_t> cells = free_cells(bodies);
    if (static_cast<std::int64_t>(cells.size()) == count_) return cells;
  }
  lay(0.0);
  std::vector<std::int64_t> cells = free_cells(bodies);
  check_room(static_cast<std::int64_t>(cells.size()));
  return cells;
}

void Fill::emit(const BodyView& bodies, double, double, std::vector<NewBody>& out) {
  if (done_) return;
  done_ = true;
  const std::vector<std::int64_t> cells = places(bodies);
  out.reserve(out.size() + cells.size());
  for (const std::int64_t cell : cells) {
    Particle particle = mixture_->draw(*particles_);
    const double play = reach_ - particle.bounding_radius;
    Vec3 at = middle(cell);
    for (int axis = 0; axis < 3; ++axis) at[axis] += places_->uniform(-play, play);
    particle.body.pose.position = at;
    out.push_back(to_body(std::move(particle), *shapes_));
  }
}

std::vector<ReportTable> Fill::report() const { return mixture_->report(); }

void Fill::save(StateWriter& out) const { out.write("done", std::uint64_t{done_}); }

void Fill::load(const StateReader& in) { done_ = in.integer("done") != 0; }

}  // namespace scree
