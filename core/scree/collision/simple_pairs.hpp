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

}  // namespace scree
