#include "face_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "scree/geometry/triangle_mesh_data.hpp"

namespace scree {
namespace {

PrimitiveData simple(ShapeKind kind, const Vec3& size, const Pose& local = {}) {
  PrimitiveData data;
  data.primitive.kind = kind;
  data.primitive.size = size;
  data.primitive.local = local;
  return data;
}

FaceMap map_of(const std::vector<PrimitiveData>& primitives, const FaceOptions& options) {
  ShapeSet shapes;
  ShapeData shape;
  shape.primitives = primitives;
  const std::uint32_t index = shapes.add(shape);
  return {shapes, shapes.shapes()[index], options};
}

double total(const FaceMap& map) { return std::accumulate(map.areas().begin(), map.areas().end(), 0.0); }

TEST(face_map, division_keeps_the_area_and_bounds_the_edges) {
  const FaceMap coarse = map_of({simple(ShapeKind::box, {0.1, 0.2, 0.3})}, {64, 1.0, 10.0});
  const FaceMap fine = map_of({simple(ShapeKind::box, {0.1, 0.2, 0.3})}, {64, 1.0, 0.03});
  EXPECT_EQ(coarse.size(), 12u);
  const double area = 8 * (0.1 * 0.2 + 0.2 * 0.3 + 0.1 * 0.3);
  EXPECT_NEAR(total(coarse), area, 1e-14);
  EXPECT_NEAR(total(fine), area, 1e-12);  // some thousand roundings
  for (const Triangle& t : fine.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(norm(fine.points()[t[k]] - fine.points()[t[(k + 1) % 3]]), 0.03);
  }
}

// A cube of 0.12 m at 0.05 mm: halving legs of 0.12 m down to longest edges below 0.05 mm makes tens of millions. Each doubling
// of the edge is a quarter of the faces: 0.0002 has 2^22 or so, so that the proposal is above that.
TEST(face_map, what_would_be_too_many_faces_is_refused_before_they_are_made) {
  const std::vector<PrimitiveData> box{simple(ShapeKind::box, {0.06, 0.06, 0.06})};
  try {
    (void)map_of(box, {64, 1.0, 5e-5});
    FAIL() << "not refused";
  } catch (const TooManyFaces& many) {
    // Right triangles halve exactly: legs of 0.12 m / 2^k have hypotenuses of 0.12 sqrt(2) / 2^k, and 2 x 4^k are on a side.
    const double k = std::ceil(std::log2(0.12 * std::numbers::sqrt2 / 5e-5));
    EXPECT_GT(many.count, 0.4 * 12.0 * std::pow(4.0, k));  // half of them where legs, not hypotenuses, end it
    EXPECT_LT(many.count, 1.1 * 12.0 * std::pow(4.0, k));
    EXPECT_GT(many.possible, kMostFaces / 5);
    EXPECT_EQ(map_of(box, {64, 1.0, many.proposed}).size(), many.possible);
  }
  EXPECT_THROW((void)map_of({simple(ShapeKind::sphere, {0.1, 0, 0})}, {2048, 1.0, 0.0}), TooManyFaces);
}

TEST(face_map, faces_are_counted_as_they_are_made) {
  const TriangleMesh mesh{{{0, 0, 0}, {1.3, 0.2, 0}, {0.4, 2.1, 0.7}, {-0.3, 0.6, 1.9}},
                          {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}}};
  for (const double largest : {5.0, 1.0, 0.3, 0.05}) {
    EXPECT_EQ(count_divided(mesh, largest, 1'000'000), divided(mesh, largest).triangles.size());
  }
  EXPECT_EQ(count_divided(mesh, 1e-4, 1000), 1001u);
}

// The nearest face holds the point: its centroid is within an edge of it, whatever the side of the box.
TEST(face_map, a_point_is_on_the_face_that_is_found_for_it) {
  const double edge = 0.02;
  const Pose aside{{1, 0, 0}, from_rotation_vector({0, 0, 0.5})};
  const FaceMap map =
      map_of({simple(ShapeKind::box, {0.1, 0.2, 0.3}), simple(ShapeKind::sphere, {0.1, 0, 0}, aside)}, {64, 1.0, edge});
  const auto centroid = [&](std::size_t face) {
    const Triangle& t = map.triangles()[face];
    return (map.points()[t[0]] + map.points()[t[1]] + map.points()[t[2]]) / 3.0;
  };
  for (const Vec3& p :
       {Vec3{0.1, 0.05, -0.2}, Vec3{-0.03, 0.2, 0.11}, Vec3{0.02, 0.04, 0.301}, Vec3{0.0, 0.0, -0.299}}) {
    const std::size_t face = map.nearest(0, p);
    EXPECT_EQ(map.primitive(face), 0u);
    EXPECT_LE(norm(centroid(face) - p), edge);
  }
  const Vec3 on_sphere = Vec3{1, 0, 0} + 0.1 * normalized(Vec3{1, 2, -2});
  const std::size_t face = map.nearest(1, on_sphere);
  EXPECT_EQ(map.primitive(face), 1u);
  EXPECT_LE(norm(centroid(face) - on_sphere), edge);
}

// Meshes keep their faces, in order; an open one is as good.
TEST(face_map, a_mesh_keeps_its_own_faces) {
  PrimitiveData sheet = simple(ShapeKind::triangle_mesh, {});
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const FaceMap map = map_of({sheet}, {});
  ASSERT_EQ(map.size(), 2u);
  EXPECT_EQ(map.nearest(0, {0.9, 0.1, 0.2}), 0u);
  EXPECT_EQ(map.nearest(0, {0.1, 0.9, -0.2}), 1u);
  EXPECT_DOUBLE_EQ(map.areas()[0], 0.5);
}

// Of inscribed polyhedra: within 1 % of the smooth surfaces at 64 segments.
TEST(face_map, round_shapes_have_their_area) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(total(map_of({simple(ShapeKind::sphere, {0.5, 0, 0})}, {})), pi, 0.01 * pi);
  EXPECT_NEAR(total(map_of({simple(ShapeKind::cylinder, {0.5, 1.0, 0})}, {})), 2.5 * pi, 0.025 * pi);
  EXPECT_NEAR(total(map_of({simple(ShapeKind::capsule, {0.5, 1.0, 0})}, {})), 3.0 * pi, 0.03 * pi);
  const double side = std::hypot(0.5, 2.0);
  EXPECT_NEAR(total(map_of({simple(ShapeKind::cone, {0.5, 1.0, 0})}, {})), pi * 0.5 * (side + 0.5), 0.05);
  EXPECT_NEAR(total(map_of({simple(ShapeKind::plane, {})}, {64, 2.0, 0.0})), 4.0, 1e-12);
  PrimitiveData drum = simple(ShapeKind::cylinder, {0.5, 1.0, 0});
  drum.primitive.hollow = true;
  EXPECT_NEAR(total(map_of({drum}, {})), 2.5 * pi, 0.025 * pi);  // with its lids
}

TEST(face_map, what_nothing_touches_has_no_faces) {
  PrimitiveData ghost = simple(ShapeKind::box, {1, 1, 1});
  ghost.primitive.collides = false;
  EXPECT_EQ(map_of({ghost}, {}).size(), 0u);
}

}  // namespace
}  // namespace scree
