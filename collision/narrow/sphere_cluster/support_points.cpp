#include "support_points.hpp"

#include <cmath>
#include <numbers>

namespace scree::sphere_cluster {
namespace {

/// Three rim points at height z, 120 degrees apart; the first one is the lowest against `up`.
void add_rim(double r, double z, const Vec3& up, std::vector<Sphere>& out) {
  const double side = std::hypot(up.x, up.y);
  // Standing upright, every rim point is equally low: any fixed one may be first.
  const Vec3 lowest = side > 1e-9 ? Vec3{-up.x / side, -up.y / side, 0.0} : Vec3{1, 0, 0};
  const Vec3 across{-lowest.y, lowest.x, 0.0};
  const double sine = 0.5 * std::numbers::sqrt3;
  const Vec3 centre{0, 0, z};
  out.push_back({centre + r * lowest, 0.0});
  out.push_back({centre + r * (-0.5 * lowest + sine * across), 0.0});
  out.push_back({centre + r * (-0.5 * lowest - sine * across), 0.0});
}

}  // namespace

void support_points(const SolidSet& set, const Solid& solid, const Vec3& up, std::vector<Sphere>& out) {
  out.clear();
  const Vec3& s = solid.size;
  const Primitive& primitive = set.shapes->primitives()[solid.primitive];
  switch (solid.kind) {
    case ShapeKind::box:
      for (int i = 0; i < 8; ++i) {
        const auto sign = [i](int bit) { return (i >> bit & 1) != 0 ? 1.0 : -1.0; };
        out.push_back({hadamard({sign(0), sign(1), sign(2)}, s), 0.0});
      }
      return;
    case ShapeKind::cylinder:
      add_rim(s.x, -s.y, up, out);
      add_rim(s.x, s.y, up, out);
      return;
    case ShapeKind::cone:
      add_rim(s.x, -s.y, up, out);
      out.push_back({{0, 0, s.y}, 0.0});
      return;
    case ShapeKind::capsule:
      out.push_back({{0, 0, -s.y}, s.x});
      out.push_back({{0, 0, s.y}, s.x});
      return;
    case ShapeKind::ellipsoid: {
      const Vec3 stretched = hadamard(s, up);
      out.push_back({hadamard(s, stretched) / -norm(stretched), 0.0});
      return;
    }
    case ShapeKind::convex_hull:
    case ShapeKind::triangle_mesh:
      for (const Vec3& v : set.shapes->vertices().subspan(primitive.first_vertex, primitive.vertex_count)) {
        out.push_back({v, 0.0});
      }
      return;
    case ShapeKind::sphere:
    case ShapeKind::sphere_cluster:
    case ShapeKind::plane:
      return;
  }
}

}  // namespace scree::sphere_cluster
