#include "slots.hpp"

#include <algorithm>
#include <cmath>

#include "scree/collision/simple_pairs.hpp"
#include "scree/math/aabb.hpp"
#include "scree/math/morton.hpp"
#include "scree/model/shape_set.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kGrain = 4096;

/// 0 where a body is no ball [m].
double ball_radius(const ShapeSet& shapes, std::uint32_t shape) {
  return is_ball(shapes, shape) ? only_primitive(shapes, shape)->size.x : 0.0;
}

bool is_even(const Vec3& moments) { return moments.x == moments.y && moments.y == moments.z; }

}  // namespace

void Slots::sort(const BodyView& bodies) {
  const std::size_t n = bodies.size();
  Aabb box = Aabb::empty();
  for (std::size_t i = 0; i < n; ++i) {
    if (bodies.motion[i] == Motion::dynamic && is_finite(bodies.position[i])) box = merged(box, bodies.position[i]);
  }
  const Vec3 size = box.upper - box.lower;
  const double longest = std::max({size.x, size.y, size.z});
  constexpr double kLast = (1u << kMortonBits) - 1;
  const double scale = longest > 0.0 && std::isfinite(longest) ? kLast / longest : 0.0;
  std::vector<std::pair<std::uint64_t, BodyIndex>> coded(n);
  const auto cell = [&](double x) { return static_cast<std::uint64_t>(std::clamp(scale * x, 0.0, kLast)); };
  for (BodyIndex i = 0; i < n; ++i) {
    // What does not move by forces comes last.
    std::uint64_t code = ~std::uint64_t{0};
    if (bodies.motion[i] == Motion::dynamic && is_finite(bodies.position[i])) {
      const Vec3 at = bodies.position[i] - box.lower;
      code = morton_code(cell(at.x), cell(at.y), cell(at.z));
    }
    coded[i] = {code, i};
  }
  std::ranges::sort(coded);
  body.resize(n);
  for (std::size_t k = 0; k < n; ++k) body[k] = coded[k].second;
  set_order(body);
}

void Slots::set_order(std::span<const BodyIndex> bodies) {
  if (bodies.data() != body.data()) body.assign(bodies.begin(), bodies.end());
  slot_of.resize(body.size());
  for (Slot k = 0; k < body.size(); ++k) slot_of[body[k]] = k;
}

std::size_t Slots::flat_of(Slot slot) const {
  const auto at = std::ranges::lower_bound(flats, slot, {}, &Flat::slot);
  return at != flats.end() && at->slot == slot ? static_cast<std::size_t>(at - flats.begin()) : flats.size();
}

void Slots::load(const BodyView& bodies, const ShapeSet& shapes, std::span<const BodyIndex> oriented,
                 const Executor& executor) {
  const std::size_t n = size();
  place.resize(n), moving.resize(n), inverse_moment.resize(n), material.resize(n);
  old.resize(n), field_force.resize(n);
  executor.for_chunks(n, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const BodyIndex i = body[k];
      const bool dynamic = bodies.motion[i] == Motion::dynamic;
      place[k] = {bodies.position[i], ball_radius(shapes, bodies.shape[i])};
      moving[k] = {.linear = bodies.velocity[i],
                   .inverse_mass = dynamic ? 1.0 / bodies.mass[i] : 0.0,
                   .angular = bodies.angular_velocity[i]};
      material[k] = bodies.material[i];
      inverse_moment[k] = dynamic && is_even(bodies.inertia[i]) ? 1.0 / bodies.inertia[i].x : 0.0;
    }
  });
  find_flats(bodies, shapes);
  find_turning(bodies, shapes, oriented);
}

void Slots::find_flats(const BodyView& bodies, const ShapeSet& shapes) {
  flats.clear();
  for (Slot k = 0; k < size(); ++k) {
    const BodyIndex i = body[k];
    if (moving[k].is_dynamic() || !is_flat(shapes, bodies, i)) continue;
    const HalfSpace half = half_space(shapes, bodies, i);
    flats.push_back({.slot = k, .normal = half.normal, .offset = half.offset, .centre = bodies.position[i]});
  }
}

void Slots::find_turning(const BodyView& bodies, const ShapeSet& shapes, std::span<const BodyIndex> oriented) {
  turning.clear(), reach.clear(), standing.clear();
  for (Slot k = 0; k < size(); ++k) {
    const BodyIndex i = body[k];
    const bool dynamic = moving[k].is_dynamic();
    const bool plain_ball = is_ball(k) && dynamic && inverse_moment[k] > 0.0;
    if (bodies.motion[i] == Motion::fixed) {
      standing.push_back({.slot = k});
      standing.back().load.body = i;
      continue;
    }
    if (plain_ball && !std::ranges::binary_search(oriented, i)) continue;
    Turning t{.slot = k, .orientation = bodies.orientation[i]};
    t.load.body = i;
    if (dynamic) {
      const Vec3 j = bodies.inertia[i];
      t.inverse_inertia = {1.0 / j.x, 1.0 / j.y, 1.0 / j.z};
      t.momentum = rotate(t.orientation, hadamard(j, rotate_back(t.orientation, moving[k].angular)));
    }
    inverse_moment[k] = 0.0;
    turning.push_back(t);
    const double farthest = is_ball(k) ? 0.0 : shapes.shapes()[bodies.shape[i]].bounding_radius;
    reach.push_back(std::isfinite(farthest) ? farthest : farthest_from(k));
  }
}

/// Of a plane, what it can move against counts.
double Slots::farthest_from(Slot slot) const {
  double farthest = 0.0;
  for (std::size_t k = 0; k < size(); ++k) {
    if (moving[k].is_dynamic()) farthest = std::max(farthest, norm(place[k].position - place[slot].position));
  }
  return farthest;
}

void Slots::store(const BodyState& bodies, double dt, const Executor& executor) const {
  executor.for_chunks(size(), kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const BodyIndex i = body[k];
      if (bodies.view.motion[i] == Motion::fixed) continue;
      bodies.position[i] = place[k].position;
      const Vec3 mean = 0.5 * (bodies.angular_velocity[i] + moving[k].angular);
      // Those of `turning` are overwritten below.
      if (place[k].radius > 0.0 && mean != Vec3{}) {
        bodies.orientation[i] = normalized(from_rotation_vector(dt * mean) * bodies.orientation[i]);
      }
      if (!moving[k].is_dynamic()) continue;
      bodies.velocity[i] = moving[k].linear;
      bodies.angular_velocity[i] = moving[k].angular;
    }
  });
  for (const Turning& t : turning) bodies.orientation[body[t.slot]] = t.orientation;
}

void Slots::store_poses(const BodyState& bodies, std::span<const BodyIndex> some) const {
  if (some.empty()) {
    for (std::size_t k = 0; k < size(); ++k) bodies.position[body[k]] = place[k].position;
  }
  for (const BodyIndex i : some) bodies.position[i] = place[slot_of[i]].position;
  for (const Turning& t : turning) bodies.orientation[body[t.slot]] = t.orientation;
}

void Slots::report_loads(std::vector<ContactLoad>& out) const {
  out.clear();
  for (const Turning& t : turning) out.push_back(t.load);
  for (const Standing& s : standing) out.push_back(s.load);
  std::ranges::sort(out, {}, &ContactLoad::body);
}

}  // namespace scree::dem
