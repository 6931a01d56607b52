// The kinds of collider that narrow phases tell apart: those of shapes, and hollow cylinders.
#pragma once

#include <cstddef>
#include <string>

#include "scree/base/error.hpp"
#include "scree/interfaces/narrow_phase.hpp"

namespace scree::collider_kind {

inline std::size_t index(ShapeKind kind) { return static_cast<std::size_t>(kind); }

/// Narrow phases tell one more kind apart than there are: a hollow cylinder is not a cylinder.
inline constexpr std::size_t kHollow = kShapeKindCount;
inline constexpr std::size_t kKinds = kShapeKindCount + 1;

inline std::size_t index(const Primitive& primitive) { return primitive.hollow ? kHollow : index(primitive.kind); }

inline const char* name_of(std::size_t kind) {
  return kind == kHollow ? "hollow cylinder" : to_string(static_cast<ShapeKind>(kind));
}

inline bool supports(const NarrowPhase& phase, std::size_t a, std::size_t b) {
  if (a == kHollow && b == kHollow) return false;
  if (a == kHollow) return phase.supports_hollow(static_cast<ShapeKind>(b));
  if (b == kHollow) return phase.supports_hollow(static_cast<ShapeKind>(a));
  return phase.supports(static_cast<ShapeKind>(a), static_cast<ShapeKind>(b));
}

inline Error unsupported(std::size_t a, std::size_t b) {
  return Error{ErrorKind::usage, std::string{"no narrow phase of the scene computes contacts of "} + name_of(a) +
                                     " against " + name_of(b) +
                                     "; add one that does to its list of narrow phases, or give one of them "
                                     "collides = false."};
}

}  // namespace scree::collider_kind
