#include "hull.hpp"

#include <limits>

#include "triangle.hpp"

namespace scree::sphere_cluster {

Nearest nearest_on_hull(const ShapeSet& shapes, const Primitive& hull, const Vec3& p, double limit) {
  // The face that p is farthest outside of; inside of all of them it is the nearest.
  Nearest best{-std::numeric_limits<double>::infinity(), {}};
  for (const Face& face : shapes.faces().subspan(hull.first_face, hull.face_count)) {
    const double height = dot(face.normal, p) - face.offset;
    if (height > best.distance) best = {height, face.normal};
  }
  if (best.distance <= 0.0 || best.distance > limit) return best;

  // Outside: the nearest of the triangles that see p.
  const auto vertices = shapes.vertices();
  double nearest2 = std::numeric_limits<double>::infinity();
  Vec3 away;
  for (const Triangle& t : shapes.triangles().subspan(hull.first_triangle, hull.triangle_count)) {
    const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    const Vec3 n = cross(b - a, c - a);
    const double height = dot(n, p - a);
    if (height <= 0.0 || height * height >= nearest2 * squared_norm(n)) continue;
    const Vec3 from_surface = p - nearest_on_triangle(a, b, c, p).point;
    const double d2 = squared_norm(from_surface);
    if (d2 < nearest2) {
      nearest2 = d2;
      away = from_surface;
    }
  }
  // Closer to the face's plane than rounding: the face's own normal is the better one.
  const double distance = norm(away);
  if (!(distance > 1e-12 * hull.bounding_radius)) return best;
  return {distance, away / distance};
}

}  // namespace scree::sphere_cluster
