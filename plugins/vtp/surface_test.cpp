#include "vtp/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scree {
namespace {

constexpr double kPi = std::numbers::pi;
// Sums of some thousand triangles, each with a few roundings.
constexpr double kRounding = 1e-12;

// The surface of one primitive, away from the origin and turned.
Surface surface_of(PrimitiveData data) {
  data.primitive.local = {{0.3, -0.2, 0.1}, from_rotation_vector({0.4, -0.8, 0.2})};
  ShapeSet shapes;
  ShapeData shape;
  shape.primitives = {std::move(data)};
  const std::uint32_t index = shapes.add(shape);
  Surface out;
  append_surface(shapes, shapes.shapes()[index], {{1, 2, 3}, from_rotation_vector({1, 0, 1})}, {}, out);
  return out;
}

Surface surface_of(ShapeKind kind, const Vec3& size, bool hollow = false) {
  PrimitiveData data;
  data.primitive.kind = kind;
  data.primitive.size = size;
  data.primitive.hollow = hollow;
  return surface_of(data);
}

// By the divergence theorem: positive when the triangles look outwards and leave no hole.
double volume(const Surface& s) {
  double sum = 0.0;
  const Vec3 origin = s.points.front();
  for (const auto& t : s.triangles) {
    sum += dot(s.points[t[0]] - origin, cross(s.points[t[1]] - origin, s.points[t[2]] - origin)) / 6.0;
  }
  return sum;
}

double area(const Surface& s) {
  double sum = 0.0;
  for (const auto& t : s.triangles) {
    sum += 0.5 * norm(cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]));
  }
  return sum;
}

// The area of the regular polygon with 64 corners on the unit circle.
const double kPolygon = 32.0 * std::sin(2.0 * kPi / 64.0);

TEST(surface, of_a_box_encloses_its_volume_and_has_its_area) {
  const Surface s = surface_of(ShapeKind::box, {0.1, 0.2, 0.3});
  EXPECT_NEAR(volume(s), 8 * 0.1 * 0.2 * 0.3, kRounding);
  EXPECT_NEAR(area(s), 8 * (0.1 * 0.2 + 0.2 * 0.3 + 0.3 * 0.1), kRounding);
}

TEST(surface, of_a_cylinder_is_the_prism_inside_it) {
  EXPECT_NEAR(volume(surface_of(ShapeKind::cylinder, {0.2, 0.5, 0})), kPolygon * 0.2 * 0.2 * 1.0, kRounding);
}

TEST(surface, of_a_hollow_cylinder_has_no_lids) {
  const double edge = 2.0 * 0.2 * std::sin(kPi / 64.0);
  EXPECT_NEAR(area(surface_of(ShapeKind::cylinder, {0.2, 0.5, 0}, true)), 64 * edge * 1.0, kRounding);
}

TEST(surface, of_a_cone_is_the_pyramid_inside_it) {
  EXPECT_NEAR(volume(surface_of(ShapeKind::cone, {0.2, 0.5, 0})), kPolygon * 0.2 * 0.2 * 1.0 / 3.0, kRounding);
}

TEST(surface, of_round_shapes_lies_just_inside_them) {
  // A polyhedron of 64 segments a circle loses about (2 pi / 64)^2 / 4 = 0.24 % of the volume.
  const double sphere = 4.0 / 3.0 * kPi * 0.2 * 0.2 * 0.2;
  const double capsule = sphere + kPi * 0.2 * 0.2 * 1.0;
  for (const auto& [found, exact] : {std::pair{volume(surface_of(ShapeKind::sphere, {0.2, 0, 0})), sphere},
                                     std::pair{volume(surface_of(ShapeKind::capsule, {0.2, 0.5, 0})), capsule}}) {
    EXPECT_LT(found, exact);
    EXPECT_GT(found, 0.995 * exact);
  }
}

TEST(surface, of_a_cluster_shows_every_sphere_where_it_is) {
  PrimitiveData data;
  data.primitive.kind = ShapeKind::sphere_cluster;
  data.spheres = {{{1, 0, 0}, 0.1}, {{-1, 0, 0}, 0.2}};
  const double single = volume(surface_of(ShapeKind::sphere, {1, 0, 0}));
  EXPECT_NEAR(volume(surface_of(data)), single * (0.1 * 0.1 * 0.1 + 0.2 * 0.2 * 0.2), kRounding);
}

TEST(surface, of_a_mesh_is_the_mesh_also_behind_another_one) {
  PrimitiveData tetrahedron;
  tetrahedron.primitive.kind = ShapeKind::triangle_mesh;
  tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  ShapeSet shapes;
  ShapeData shape;
  shape.primitives = {tetrahedron};
  shapes.add(shape);
  for (Vec3& v : shape.primitives[0].vertices) v *= 2.0;
  const std::uint32_t second = shapes.add(shape);
  Surface out;
  append_surface(shapes, shapes.shapes()[second], {}, {}, out);
  EXPECT_NEAR(volume(out), 8.0 / 6.0, kRounding);
}

TEST(surface, of_a_plane_is_a_square_with_the_normal_of_the_plane) {
  const Surface s = surface_of(ShapeKind::plane, {});
  ASSERT_EQ(s.triangles.size(), 2u);
  EXPECT_NEAR(area(s), 1.0, kRounding);
  const Vec3 normal = rotate(from_rotation_vector({1, 0, 1}) * from_rotation_vector({0.4, -0.8, 0.2}), {0, 0, 1});
  const auto& t = s.triangles[0];
  EXPECT_NEAR(dot(normalized(cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]])), normal), 1.0,
              kRounding);
}

}  // namespace
}  // namespace scree
