// Simple pairs: two balls, or a ball and a flat wall at rest. A stepper with very short steps measures them itself, in closed
// form, and asks a narrow phase for all others only.
#pragma once

#include "scree/model/body.hpp"
#include "scree/model/shape_set.hpp"

namespace scree {

/// The one primitive of a shape, if that is all there is of it and it collides; else null.
inline const Primitive* only_primitive(const ShapeSet& shapes, std::uint32_t shape) {
  const Shape& s = shapes.shapes()[shape];
  if (s.primitive_count != 1) return nullptr;
  const Primitive& only = shapes.primitives()[s.first_primitive];
  return only.collides ? &only : nullptr;
}

/// True for a sphere about the body's origin, Primitive::size.x its radius.
inline bool is_ball(const ShapeSet& shapes, std::uint32_t shape) {
  const Primitive* only = only_primitive(shapes, shape);
  return only != nullptr && only->kind == ShapeKind::sphere && only->local == Pose{};
}

/// True for a body that is a plane, stands still, and whose surface does.
inline bool is_flat(const ShapeSet& shapes, const BodyView& bodies, BodyIndex i) {
  if (bodies.motion[i] != Motion::fixed) return false;
  const Primitive* only = only_primitive(shapes, bodies.shape[i]);
  return only != nullptr && only->kind == ShapeKind::plane && surface_motion(bodies, i) == Twist{};
}

/// The half space below a body of is_flat(): its points x have dot(normal, x) < offset.
struct HalfSpace {
  Vec3 normal;          ///< world [1]
  double offset = 0.0;  ///< [m]
};

inline HalfSpace half_space(const ShapeSet& shapes, const BodyView& bodies, BodyIndex flat) {
  const Pose plane =
      Pose{bodies.position[flat], bodies.orientation[flat]} * only_primitive(shapes, bodies.shape[flat])->local;
  const Vec3 normal = rotate(plane.orientation, {0, 0, 1});
  return {normal, dot(normal, plane.position)};
}

/// Gap of a simple pair [m], negative where it overlaps.
inline double simple_gap(const ShapeSet& shapes, const BodyView& bodies, BodyIndex a, BodyIndex b) {
  const auto above = [&](BodyIndex flat, BodyIndex ball) {
    const HalfSpace half = half_space(shapes, bodies, flat);
    return dot(half.normal, bodies.position[ball]) - half.offset - bodies.radius[ball];
  };
  if (is_flat(shapes, bodies, a)) return above(a, b);
  if (is_flat(shapes, bodies, b)) return above(b, a);
  return norm(bodies.position[b] - bodies.position[a]) - bodies.radius[a] - bodies.radius[b];
}

}  // namespace scree
