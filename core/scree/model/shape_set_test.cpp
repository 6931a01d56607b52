#include "scree/model/shape_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scree/model/random.hpp"

namespace scree {
namespace {

/// A random point of the solid's surface, in its own frame; sampled independently of bounds().
Vec3 surface_point(ShapeKind kind, const Vec3& s, RandomStream& random) {
  const Vec3 d = rotate(random.orientation(), {0, 0, 1});
  const double u = random.uniform(-1, 1), t = random.uniform(0, 6.283185307179586);
  switch (kind) {
    case ShapeKind::box:
      return {d.x > 0 ? s.x : -s.x, d.y > 0 ? s.y : -s.y, d.z > 0 ? s.z : -s.z};
    case ShapeKind::cylinder:
      return {s.x * std::cos(t), s.x * std::sin(t), u > 0 ? s.y : -s.y};
    case ShapeKind::capsule:
      return s.x * d + Vec3{0, 0, d.z > 0 ? s.y : -s.y};
    case ShapeKind::cone:
      return u > 0.9 ? Vec3{0, 0, s.y} : Vec3{s.x * std::cos(t), s.x * std::sin(t), -s.y};
    case ShapeKind::ellipsoid:
      return hadamard(s, d);
    default:
      return s.x * d;
  }
}

// Law: bounds() contains the solid and every face of the box touches it. With 4000 samples of the extreme features the
// largest sample lies within 2 % of the size of the true extreme.
TEST(ShapeSet, bounds_are_tight) {
  RandomStream random{3, "bounds"};
  const ShapeSet shapes;
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::box, ShapeKind::cylinder, ShapeKind::capsule,
                               ShapeKind::cone, ShapeKind::ellipsoid}) {
    for (int trial = 0; trial < 20; ++trial) {
      Primitive p;
      p.kind = kind;
      p.size = {random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)};
      const Pose world{{random.uniform(-5, 5), 0, 1}, random.orientation()};
      const Aabb box = bounds(shapes, p, world);
      Aabb seen = Aabb::empty();
      for (int i = 0; i < 4000; ++i) seen = merged(seen, transform(world, surface_point(kind, p.size, random)));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(box.lower[axis], seen.lower[axis] + 1e-12) << to_string(kind);
        EXPECT_GE(box.upper[axis], seen.upper[axis] - 1e-12) << to_string(kind);
        EXPECT_NEAR(box.lower[axis], seen.lower[axis], 0.08) << to_string(kind);
        EXPECT_NEAR(box.upper[axis], seen.upper[axis], 0.08) << to_string(kind);
      }
    }
  }
}

TEST(ShapeSet, ranges_and_triangle_indices_are_moved_to_the_common_buffers) {
  ShapeSet shapes;
  PrimitiveData mesh;
  mesh.primitive.kind = ShapeKind::triangle_mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  shapes.add({"one", {mesh}, 0.0, {}, {}});
  const std::uint32_t two = shapes.add({"two", {mesh}, 0.0, {}, {}});
  const Primitive& p = shapes.primitives(shapes.shapes()[two])[0];
  EXPECT_EQ(p.first_vertex, 3u);
  EXPECT_EQ(shapes.triangles()[p.first_triangle], (Triangle{3, 4, 5}));
  EXPECT_EQ(shapes.find("two"), 1);
  EXPECT_EQ(shapes.find("three"), -1);
}

TEST(ShapeSet, planes_are_unbounded_but_for_their_free_side) {
  Primitive plane;
  plane.kind = ShapeKind::plane;
  const Aabb floor = bounds(ShapeSet{}, plane, {{0, 0, 0.25}, {}});
  EXPECT_EQ(floor.upper.z, 0.25);
  EXPECT_FALSE(is_bounded(floor));
}

}  // namespace
}  // namespace scree
