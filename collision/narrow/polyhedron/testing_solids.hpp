// Solids for the tests of this plugin: what they are, their corners, and the radius of the sphere that sweeps them.
#pragma once

#include <string>
#include <vector>

#include "scree/geometry/convex_hull.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree::test {

/// A primitive with its corners in its own frame.
struct Solid {
  std::string name;
  PrimitiveData data;
  std::vector<Vec3> corners;  // [m]
  double radius = 0.0;        // of the sweep [m]
  double size = 0.0;          // farthest point from the origin [m]

  [[nodiscard]] std::vector<Vec3> placed(const Pose& pose) const {
    std::vector<Vec3> out;
    for (const Vec3& c : corners) out.push_back(transform(pose, c));
    return out;
  }
};

inline Solid finished(Solid s) {
  for (const Vec3& c : s.corners) s.size = std::max(s.size, norm(c) + s.radius);
  return s;
}
inline Solid box_solid(const Vec3& half) {
  Solid s{"box", primitive_data(ShapeKind::box, half), box_mesh(half).vertices};
  return finished(s);
}
inline Solid hull_solid(const std::vector<Vec3>& points) {
  const ConvexHull hull = convex_hull(points);
  Solid s{"hull", mesh_data(hull.vertices, hull.triangles), hull.vertices};
  s.data.primitive.kind = ShapeKind::convex_hull;
  s.data.faces = hull.faces;
  return finished(s);
}
inline Solid capsule_solid(double radius, double half_length) {
  Solid s{"capsule",
          primitive_data(ShapeKind::capsule, {radius, half_length, 0}),
          {{0, 0, -half_length}, {0, 0, half_length}},
          radius};
  return finished(s);
}
/// A hull of `count` points on an ellipsoid of half axes between 0.3 and 1 times `scale`.
inline Solid random_hull(RandomNumbers& random, std::size_t count, double scale) {
  const Vec3 axes{random.uniform(0.3, 1.0), random.uniform(0.3, 1.0), random.uniform(0.3, 1.0)};
  std::vector<Vec3> points;
  while (points.size() < count) points.push_back(scale * hadamard(axes, random.direction()));
  return hull_solid(points);
}
/// A prism over a regular polygon: faces with many sides, parallel edges.
inline Solid prism(int sides, double radius, double half_length) {
  return hull_solid(cylinder_mesh(radius, half_length, sides).vertices);
}

}  // namespace scree::test
