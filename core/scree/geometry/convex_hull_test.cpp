#include "scree/geometry/convex_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <thread>

#include "scree/base/error.hpp"
#include "scree/geometry/mass_properties.hpp"
#include "scree/geometry/testing_random.hpp"

namespace scree {
namespace {

using testing_random::Random;

std::vector<Vec3> random_points(Random& random, int count, double scale) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(random.in_box({-scale, -scale, -scale}, {scale, scale, scale}));
  return points;
}

/// What every hull owes: a closed outward surface of Euler number 2, no input point outside any plane, and corners on
/// the planes of their triangles.
void expect_sound(const ConvexHull& hull, std::span<const Vec3> points, double scale) {
  const MeshReport report = check_mesh(surface_of(hull));
  EXPECT_TRUE(report.is_solid()) << report.problem();
  EXPECT_EQ(report.euler, 2);
  for (const Face& face : hull.faces) {
    EXPECT_NEAR(norm(face.normal), 1.0, 1e-12);
    for (const Vec3& p : points) EXPECT_LE(dot(face.normal, p), face.offset + 1e-12 * scale);
  }
  ASSERT_EQ(hull.triangle_face.size(), hull.triangles.size());
  for (std::size_t i = 0; i < hull.triangles.size(); ++i) {
    const Face& face = hull.faces[hull.triangle_face[i]];
    for (const std::uint32_t v : hull.triangles[i]) {
      EXPECT_NEAR(dot(face.normal, hull.vertices[v]), face.offset, 1e-12 * scale);
    }
  }
}

std::string message_of(std::span<const Vec3> points) {
  try {
    (void)convex_hull(points);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// Twenty at each scale; a millimetre grain and a metre of furniture take the same path.
TEST(convex_hull, of_random_points_is_sound_at_every_scale) {
  Random random{11};
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3}) {
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<Vec3> points = random_points(random, 6 + trial, scale);
      expect_sound(convex_hull(points), points, scale);
    }
  }
}

TEST(convex_hull, a_cube_has_six_faces_and_eight_corners_whatever_lies_within_and_on_it) {
  Random random{12};
  const Pose pose{{1, 2, 3}, random.rotation()};
  for (const bool turned : {false, true}) {
    std::vector<Vec3> points = box_mesh({1, 1, 1}).vertices;
    for (int i = 0; i < 50; ++i) points.push_back(random.in_box({-0.9, -0.9, -0.9}, {0.9, 0.9, 0.9}));
    points.push_back({1, 0.3, 0.2});  // on a face
    points.push_back({0, 0, 0});
    points.push_back(points[3]);  // a double
    if (turned) {
      for (Vec3& p : points) p = transform(pose, p);
    }
    const ConvexHull hull = convex_hull(points);
    EXPECT_EQ(hull.faces.size(), 6u);
    EXPECT_EQ(hull.vertices.size(), 8u);
    EXPECT_EQ(hull.triangles.size(), 12u);
    EXPECT_NEAR(mesh_mass_properties(surface_of(hull)).volume, 8.0, 1e-11);
    expect_sound(hull, points, 5.0);
  }
}

TEST(convex_hull, a_prism_keeps_its_polygons_whole) {
  const TriangleMesh prism = cylinder_mesh(1e-3, 2e-3, 12);
  const ConvexHull hull = convex_hull(prism.vertices);
  EXPECT_EQ(hull.faces.size(), 14u);
  EXPECT_EQ(hull.vertices.size(), 24u);  // the middles of the ends are no corners
}

// The volume of a tetrahedron is a sixth of the determinant of its edges.
TEST(convex_hull, of_four_points_is_the_tetrahedron) {
  Random random{13};
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<Vec3> p = random_points(random, 4, 1.0);
    const double closed = std::abs(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0]))) / 6.0;
    EXPECT_NEAR(mesh_mass_properties(surface_of(convex_hull(p))).volume, closed, 1e-13);
  }
}

TEST(convex_hull, does_not_depend_on_the_order_of_the_points) {
  Random random{14};
  std::vector<Vec3> points = random_points(random, 30, 1.0);
  const ConvexHull first = convex_hull(points);
  const auto corners = [](const ConvexHull& hull) {
    std::set<std::array<double, 3>> set;
    for (const Vec3& v : hull.vertices) set.insert({v.x, v.y, v.z});
    return set;
  };
  for (int trial = 0; trial < 10; ++trial) {
    std::shuffle(points.begin(), points.end(), random.engine());
    const ConvexHull again = convex_hull(points);
    EXPECT_EQ(corners(again), corners(first));
    EXPECT_EQ(again.faces.size(), first.faces.size());
    EXPECT_NEAR(mesh_mass_properties(surface_of(again)).volume, mesh_mass_properties(surface_of(first)).volume, 1e-12);
  }
}

TEST(convex_hull, refuses_too_few_flat_and_unreal_points_with_a_sentence) {
  EXPECT_NE(message_of(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("at least 4"), std::string::npos);
  const std::vector<Vec3> flat{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.3, 0.2, 1}};
  EXPECT_NE(message_of(flat).find("in one plane"), std::string::npos) << message_of(flat);
  const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_NE(message_of(line).find("on one line"), std::string::npos) << message_of(line);
  EXPECT_NE(message_of(std::vector<Vec3>(5, Vec3{1, 1, 1})).find("in one point"), std::string::npos);
  std::vector<Vec3> nan = box_mesh({1, 1, 1}).vertices;
  nan[5].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(nan).find("point 5"), std::string::npos) << message_of(nan);
}

TEST(convex_hull, is_safe_from_several_threads) {
  Random random{15};
  const std::vector<Vec3> points = random_points(random, 60, 1.0);
  const ConvexHull alone = convex_hull(points);
  std::vector<ConvexHull> together(4);
  std::vector<std::thread> threads;
  for (ConvexHull& hull : together) {
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) hull = convex_hull(points);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const ConvexHull& hull : together) {
    EXPECT_EQ(hull.vertices, alone.vertices);
    EXPECT_EQ(hull.triangles, alone.triangles);
    EXPECT_EQ(hull.faces, alone.faces);
  }
}

}  // namespace
}  // namespace scree
