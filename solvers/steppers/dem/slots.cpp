#include "slots.hpp"

#include <algorithm>
#include <cmath>

#include "scree/math/aabb.hpp"
#include "scree/model/shape_set.hpp"
#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kBitsPerAxis = 20;

/// Spreads the lower 20 bits so that two zeros stand between any two of them.
std::uint64_t spread(std::uint64_t x) {
  x = (x | (x << 32)) & 0x001f00000000ffffULL;
  x = (x | (x << 16)) & 0x001f0000ff0000ffULL;
  x = (x | (x << 8)) & 0x100f00f00f00f00fULL;
  x = (x | (x << 4)) & 0x10c30c30c30c30c3ULL;
  return (x | (x << 2)) & 0x1249249249249249ULL;
}

/// True for a shape of one colliding primitive, a sphere about the body's origin.
bool is_ball(const ShapeSet& shapes, const Shape& shape) {
  if (shape.primitive_count != 1) return false;
  const Primitive& only = shapes.primitives()[shape.first_primitive];
  return only.kind == ShapeKind::sphere && only.local.position == Vec3{} && only.local.orientation == Quat{};
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
  constexpr double kLast = (1u << kBitsPerAxis) - 1;
  const double scale = longest > 0.0 && std::isfinite(longest) ? kLast / longest : 0.0;
  std::vector<std::pair<std::uint64_t, BodyIndex>> coded(n);
  const auto cell = [&](double x) { return static_cast<std::uint64_t>(std::clamp(scale * x, 0.0, kLast)); };
  for (BodyIndex i = 0; i < n; ++i) {
    // What does not move by forces comes last.
    std::uint64_t code = ~std::uint64_t{0};
    if (bodies.motion[i] == Motion::dynamic && is_finite(bodies.position[i])) {
      const Vec3 at = bodies.position[i] - box.lower;
      code = spread(cell(at.x)) | (spread(cell(at.y)) << 1) | (spread(cell(at.z)) << 2);
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

void Slots::load(const BodyView& bodies, const ShapeSet& shapes, std::span<const BodyIndex> oriented,
                 const Executor& executor) {
  const std::size_t n = size();
  place.resize(n), moving.resize(n), inverse_moment.resize(n);
  old.resize(n), wrench.resize(n), field_force.resize(n);
  executor.for_chunks(n, kGrain, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const BodyIndex i = body[k];
      const Shape& shape = shapes.shapes()[bodies.shape[i]];
      const bool dynamic = bodies.motion[i] == Motion::dynamic;
      place[k] = {bodies.position[i], is_ball(shapes, shape) ? shape.equivalent_radius : 0.0};
      moving[k] = {bodies.velocity[i], bodies.angular_velocity[i], dynamic ? 1.0 / bodies.mass[i] : 0.0,
                   bodies.material[i]};
      inverse_moment[k] = dynamic && is_even(bodies.inertia[i]) ? 1.0 / bodies.inertia[i].x : 0.0;
    }
  });
  turning.clear(), reach.clear();
  for (Slot k = 0; k < n; ++k) {
    const BodyIndex i = body[k];
    const bool dynamic = moving[k].is_dynamic();
    const bool plain_ball = place[k].radius > 0.0 && (!dynamic || inverse_moment[k] > 0.0);
    if (bodies.motion[i] == Motion::fixed) continue;
    if (plain_ball && std::ranges::find(oriented, i) == oriented.end()) continue;
    Turning t{.slot = k, .orientation = bodies.orientation[i], .momentum = {}, .torque = {}, .inverse_inertia = {}};
    if (dynamic) {
      const Vec3 j = bodies.inertia[i];
      t.inverse_inertia = {1.0 / j.x, 1.0 / j.y, 1.0 / j.z};
      t.momentum = rotate(t.orientation, hadamard(j, rotate_back(t.orientation, moving[k].angular)));
    }
    inverse_moment[k] = 0.0;
    turning.push_back(t);
    double farthest = shapes.shapes()[bodies.shape[i]].bounding_radius;
    if (!std::isfinite(farthest)) {  // a plane: what it can move against counts
      farthest = 0.0;
      for (std::size_t other = 0; other < n; ++other) {
        if (!moving[other].is_dynamic()) continue;
        farthest = std::max(farthest, norm(place[other].position - place[k].position));
      }
    }
    reach.push_back(farthest);
  }
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

}  // namespace scree::dem
