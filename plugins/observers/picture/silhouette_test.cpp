#include "silhouette.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "label_places.hpp"

namespace scree {
namespace {

constexpr double kRounding = 1e-14;  // a few roundings of numbers of order one
const Projection kFront{{1, 0, 0}, {0, 1, 0}};

std::vector<Silhouette> silhouettes(PrimitiveData data, const Pose& pose, const Projection& projection = kFront) {
  ShapeSet shapes;
  ShapeData shape;
  shape.primitives = {std::move(data)};
  const std::uint32_t index = shapes.add(shape);
  std::vector<Silhouette> out;
  append_silhouettes(shapes, shapes.shapes()[index], pose, projection, out);
  return out;
}

std::vector<Silhouette> silhouettes(ShapeKind kind, const Vec3& size, const Pose& pose,
                                    const Projection& projection = kFront) {
  PrimitiveData data;
  data.primitive.kind = kind;
  data.primitive.size = size;
  return silhouettes(std::move(data), pose, projection);
}

// Positive for corners in counter-clockwise order.
double area(const std::vector<Point2>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) sum += 0.5 * cross(corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

TEST(projection, named_axes_are_coordinates_and_depth_grows_towards_the_viewer) {
  const Projection top{{1, 0, 0}, {0, 0, 1}};  // x to the right, z up: the viewer stands at -y
  const Point2 p = top({1, 2, 3});
  EXPECT_EQ(p.x, 1.0);
  EXPECT_EQ(p.y, 3.0);
  EXPECT_EQ(top.depth({1, 2, 3}), -2.0);
  EXPECT_EQ(axis_label({0, 0, -1}, "up"), "-z [m]");
  EXPECT_EQ(axis_label({0.6, 0.8, 0}, "right"), "right [m]");
}

TEST(projection, keeps_lengths_in_the_plane_and_drops_those_along_the_view) {
  const double s = std::sqrt(0.5);
  const Projection oblique{{s, 0, -s}, {0, 1, 0}};
  const Point2 p = oblique(3.0 * Vec3{s, 0, -s} + 2.0 * Vec3{0, 1, 0} + 7.0 * Vec3{s, 0, s});
  EXPECT_NEAR(p.x, 3.0, kRounding);
  EXPECT_NEAR(p.y, 2.0, kRounding);
}

TEST(convex_outline, leaves_out_what_is_inside_and_on_edges) {
  const std::vector<Point2> hull = convex_outline({{0, 0}, {2, 0}, {1, 0}, {1, 1}, {2, 2}, {0, 2}, {0, 1}});
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_DOUBLE_EQ(area(hull), 4.0);
}

TEST(silhouette, of_a_box_along_an_axis_is_its_face) {
  const auto parts = silhouettes(ShapeKind::box, {0.1, 0.2, 0.3}, {{1, 2, 3}, {}});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].outline.size(), 4u);
  EXPECT_NEAR(area(parts[0].outline), 0.2 * 0.4, kRounding);
  EXPECT_EQ(parts[0].depth, 3.0);
  EXPECT_TRUE(covers(parts[0], {1.09, 2.19}));
  EXPECT_FALSE(covers(parts[0], {1.11, 2.0}));
}

TEST(silhouette, of_a_cube_along_its_diagonal_is_a_hexagon_of_area_root_three) {
  const Vec3 to_viewer = normalized(Vec3{1, 1, 1}), right = normalized(Vec3{1, -1, 0});
  const auto parts = silhouettes(ShapeKind::box, {0.5, 0.5, 0.5}, {}, {right, cross(to_viewer, right)});
  EXPECT_EQ(parts[0].outline.size(), 6u);
  EXPECT_NEAR(area(parts[0].outline), std::sqrt(3.0), kRounding);
}

TEST(silhouette, of_a_cylinder_is_a_circle_end_on_and_a_rectangle_from_the_side) {
  const auto end_on = silhouettes(ShapeKind::cylinder, {0.16, 0.15, 0}, {});
  for (const Point2 corner : end_on[0].outline) EXPECT_NEAR(std::hypot(corner.x, corner.y), 0.16, kRounding);
  // The polygon of n corners has the share sin(2 pi / n) / (2 pi / n) of the area of its circle: 1 - 4.6e-4 for 120.
  EXPECT_NEAR(area(end_on[0].outline) / (std::numbers::pi * 0.16 * 0.16), 1.0, 5e-4);
  const auto side = silhouettes(ShapeKind::cylinder, {0.16, 0.15, 0}, {}, {{1, 0, 0}, {0, 0, 1}});
  EXPECT_NEAR(area(side[0].outline), 0.32 * 0.3, kRounding);
}

TEST(silhouette, of_a_tilted_capsule_is_its_stadium) {
  const double radius = 0.1, half = 0.3, tilt = 0.4;
  const auto parts = silhouettes(ShapeKind::capsule, {radius, half, 0}, {{}, from_rotation_vector({tilt, 0, 0})});
  const double stadium = std::numbers::pi * radius * radius + 2.0 * radius * 2.0 * half * std::sin(tilt);
  EXPECT_NEAR(area(parts[0].outline), stadium, 5e-4 * stadium);  // circles of 120 corners
}

TEST(silhouette, of_a_cluster_is_a_disc_for_each_sphere_and_of_a_mesh_a_triangle_for_each) {
  PrimitiveData cluster;
  cluster.primitive.kind = ShapeKind::sphere_cluster;
  cluster.spheres = {{{1, 0, 0}, 0.2}, {{0, 0, 1}, 0.3}};
  const auto discs = silhouettes(cluster, {{0, 5, 0}, {}});
  ASSERT_EQ(discs.size(), 2u);
  EXPECT_EQ(discs[0].centre.x, 1.0);
  EXPECT_EQ(discs[0].centre.y, 5.0);
  EXPECT_EQ(discs[1].radius, 0.3);
  EXPECT_EQ(discs[1].depth, 1.0);

  PrimitiveData mesh;
  mesh.primitive.kind = ShapeKind::triangle_mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  const auto triangles = silhouettes(mesh, {});
  ASSERT_EQ(triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(area(triangles[0].outline), 0.5);
}

TEST(silhouette, of_a_ghost_says_so_and_a_plane_has_none) {
  PrimitiveData ghost;
  ghost.primitive.kind = ShapeKind::box;
  ghost.primitive.size = {1, 1, 1};
  ghost.primitive.collides = false;
  EXPECT_FALSE(silhouettes(ghost, {})[0].collides);
  EXPECT_TRUE(silhouettes(ShapeKind::plane, {}, {}).empty());
}

TEST(window, with_a_margin_holds_everything_and_is_never_flat) {
  Window window = Window::empty();
  window.include({0, 0}, 0.5);
  window.include({8.5, 0});
  const Window seen = with_margin(window);
  EXPECT_LT(seen.lower.x, -0.5);
  EXPECT_GT(seen.upper.x, 8.5);
  EXPECT_GE(seen.height(), seen.width() / 3.0);
  EXPECT_GT(with_margin(Window::empty()).width(), 0.0);
}

TEST(label_places, a_box_meets_a_polygon_where_it_crosses_it_and_not_beside_its_slope) {
  const std::vector<plot::Canvas::Point> sliver{{50, 0}, {51, 0}, {51, 100}, {50, 100}};
  EXPECT_TRUE(overlap({0, 40, 100, 50}, sliver));  // no corner of one lies in the other
  EXPECT_FALSE(overlap({0, 40, 49, 50}, sliver));
  const std::vector<plot::Canvas::Point> slope{{0, 0}, {100, 100}, {0, 100}};
  EXPECT_FALSE(overlap({60, 0, 100, 50}, slope));  // bounds overlap, the shapes do not
  EXPECT_TRUE(overlap({40, 0, 100, 50}, slope));
}

TEST(label_places, labels_avoid_bodies_each_other_and_the_frame) {
  const Box body{80, 80, 120, 120};
  const std::vector<plot::Canvas::Point> outline{{80, 80}, {120, 80}, {120, 120}, {80, 120}};
  LabelPlaces places{{0, 0, 200, 200}, {outline, {{0, 0}, {79, 0}, {79, 200}, {0, 200}}}};
  const auto above = places.place(body, 30, 10);
  ASSERT_TRUE(above.has_value());
  EXPECT_LT(above->bottom, body.top);
  EXPECT_GT(above->bottom, body.top - 8);                   // near it
  EXPECT_GT(places.place(body, 30, 10)->top, body.bottom);  // above is kept
  EXPECT_GT(places.place(body, 30, 10)->left, body.right);
  EXPECT_FALSE(places.place(body, 30, 10).has_value());  // the left is another body's
}

}  // namespace
}  // namespace scree
