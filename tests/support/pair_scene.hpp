// PairScene: two primitives at two poses, for unit tests of narrow phases.
//
//     PairScene scene{sphere_data(1e-3), plane_data()};
//     const ContactBuffer contacts = scene.collide(phase, {{0, 0, 2e-3}, {}}, {}, reach);
#pragma once

#include <vector>

#include "scree/interfaces/narrow_phase.hpp"

namespace scree::test {

inline PrimitiveData primitive_data(ShapeKind kind, const Vec3& size = {}, bool hollow = false) {
  PrimitiveData data;
  data.primitive.kind = kind;
  data.primitive.size = size;
  data.primitive.hollow = hollow;
  return data;
}
inline PrimitiveData sphere_data(double radius) { return primitive_data(ShapeKind::sphere, {radius, 0, 0}); }
inline PrimitiveData plane_data() { return primitive_data(ShapeKind::plane); }
inline PrimitiveData cluster_data(std::vector<Sphere> spheres) {
  PrimitiveData data = primitive_data(ShapeKind::sphere_cluster);
  data.spheres = std::move(spheres);
  return data;
}
inline PrimitiveData mesh_data(std::vector<Vec3> vertices, std::vector<Triangle> triangles) {
  PrimitiveData data = primitive_data(ShapeKind::triangle_mesh);
  data.vertices = std::move(vertices);
  data.triangles = std::move(triangles);
  return data;
}
/// A hull of given vertices and triangles (counter-clockwise seen from outside), one face a triangle.
inline PrimitiveData hull_data(std::vector<Vec3> vertices, std::vector<Triangle> triangles) {
  PrimitiveData data = mesh_data(std::move(vertices), std::move(triangles));
  data.primitive.kind = ShapeKind::convex_hull;
  for (const Triangle& t : data.triangles) {
    const Vec3& a = data.vertices[t[0]];
    const Vec3 n = normalized(cross(data.vertices[t[1]] - a, data.vertices[t[2]] - a));
    data.faces.push_back({n, dot(n, a)});
  }
  return data;
}

/// A shape of one primitive.
inline ShapeData shape_data(PrimitiveData primitive) {
  ShapeData data;
  data.primitives.push_back(std::move(primitive));
  return data;
}

/// Two primitives, of bodies 0 and 1.
class PairScene {
 public:
  PairScene(PrimitiveData a, PrimitiveData b) {
    shapes_.add(shape_data(std::move(a)));
    shapes_.add(shape_data(std::move(b)));
  }
  /// Contacts with a gap below `reach` [m] at these poses.
  [[nodiscard]] ContactBuffer collide(NarrowPhase& phase, const Pose& a, const Pose& b, double reach) {
    if (!bound_) phase.bind(shapes_, 0);
    bound_ = true;
    pose_ = {a, b};
    for (std::size_t i = 0; i < 2; ++i) {
      kind_[i] = shapes_.primitives()[i].kind;
      ball_[i] = {pose_[i].position, shapes_.primitives()[i].bounding_radius};
    }
    const ColliderView view{key_, body_, primitive_, ordinal_, pose_, movable_, kind_, ball_};
    const ColliderPair pair{0, 1, reach};
    ContactBuffer out;
    phase.collide(view, {&pair, 1}, out);
    return out;
  }
  [[nodiscard]] const ShapeSet& shapes() const { return shapes_; }

 private:
  ShapeSet shapes_;
  bool bound_ = false;
  std::vector<std::uint64_t> key_{0, 1};
  std::vector<BodyIndex> body_{0, 1};
  std::vector<std::uint32_t> primitive_{0, 1};
  std::vector<std::uint32_t> ordinal_{0, 0};
  std::vector<Pose> pose_{2};
  std::vector<char> movable_{1, 1};
  std::vector<ShapeKind> kind_ = std::vector<ShapeKind>(2);
  std::vector<BoundingBall> ball_{2};
};

}  // namespace scree::test
