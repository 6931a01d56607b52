#include "convex_solid.hpp"

#include <cmath>

namespace scree::convex {
namespace {

/// The point of a disc of radius r farthest along d, or its centre when none is.
Vec3 on_rim(double r, const Vec3& d, double z) {
  const double across = std::hypot(d.x, d.y);
  if (!(across > 0.0)) return {0.0, 0.0, z};
  return {r * d.x / across, r * d.y / across, z};
}

Vec3 on_cone(const Vec3& size, const Vec3& d) {
  const double apex = size.y * d.z;
  const double base = size.x * std::hypot(d.x, d.y) - size.y * d.z;
  return apex > base ? Vec3{0.0, 0.0, size.y} : on_rim(size.x, d, -size.y);
}

Vec3 on_ellipsoid(const Vec3& axes, const Vec3& d) {
  const Vec3 stretched = hadamard(axes, d);
  const double length = norm(stretched);
  return length > 0.0 ? hadamard(axes, stretched) / length : Vec3{axes.x, 0.0, 0.0};
}

Vec3 on_hull(const ConvexSolid& solid, const Vec3& d) {
  std::size_t best = 0;
  double farthest = dot(solid.vertices[0], d);
  for (std::size_t i = 1; i < solid.vertices.size(); ++i) {
    const double along = dot(solid.vertices[i], d);
    if (along > farthest) {
      farthest = along;
      best = i;
    }
  }
  return solid.scale * solid.vertices[best];
}

}  // namespace

Vec3 local_core_support(const ConvexSolid& solid, const Vec3& d) {
  const Vec3& s = solid.size;
  switch (solid.kind) {
    case ShapeKind::box:
      return {std::copysign(s.x, d.x), std::copysign(s.y, d.y), std::copysign(s.z, d.z)};
    case ShapeKind::cylinder:
      return on_rim(s.x, d, std::copysign(s.y, d.z));
    case ShapeKind::capsule:
      return {0.0, 0.0, std::copysign(s.y, d.z)};
    case ShapeKind::cone:
      return on_cone(s, d);
    case ShapeKind::ellipsoid:
      return on_ellipsoid(s, d);
    case ShapeKind::convex_hull:
      return on_hull(solid, d);
    case ShapeKind::sphere:
    case ShapeKind::sphere_cluster:
    case ShapeKind::plane:
    case ShapeKind::triangle_mesh:
      break;
  }
  return {};
}

}  // namespace scree::convex
