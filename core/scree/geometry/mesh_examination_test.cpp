#include "scree/geometry/mesh_examination.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "scree/geometry/convex_hull.hpp"
#include "scree/geometry/testing_random.hpp"

namespace scree {
namespace {

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

TriangleMesh operator+(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

TriangleMesh cube(double half = 1.0) { return box_mesh({half, half, half}); }

/// A ball-like hull of random points on a sphere of radius 1 mm.
TriangleMesh ball() {
  testing_random::Random random{3};
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) points.push_back(1e-3 * random.direction());
  return surface_of(convex_hull(points));
}

/// A strip of `pieces` quadrilaterals around the z axis, turned by half turns `halves` times.
TriangleMesh strip(std::uint32_t pieces, int halves) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < pieces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / pieces, tilt = 0.5 * halves * angle;
    const Vec3 out{std::cos(angle), std::sin(angle), 0};
    const Vec3 across = std::cos(tilt) * out + Vec3{0, 0, std::sin(tilt)};
    mesh.vertices.push_back(out - 0.3 * across);
    mesh.vertices.push_back(out + 0.3 * across);
  }
  for (std::uint32_t i = 0; i < pieces; ++i) {
    const bool last = i + 1 == pieces;
    std::uint32_t c = last ? 0 : 2 * i + 2, d = last ? 1 : 2 * i + 3;
    if (last && halves % 2 == 1) std::swap(c, d);
    mesh.triangles.push_back({2 * i, c, d});
    mesh.triangles.push_back({2 * i, d, 2 * i + 1});
  }
  return mesh;
}

void expect_says(const TriangleMesh& mesh, const std::string& words) {
  const std::string problem = examine_mesh(mesh).problem();
  EXPECT_NE(problem.find(words), std::string::npos) << problem;
}

TEST(examine_mesh, finds_nothing_wrong_with_solids) {
  EXPECT_EQ(examine_mesh(cube()).problem(), "");
  EXPECT_EQ(examine_mesh(cylinder_mesh(1e-3, 0.1, 100)).problem(), "");
  EXPECT_EQ(examine_mesh(ball()).problem(), "");
  EXPECT_EQ(examine_mesh(ball()).shells, 1u);
  EXPECT_EQ(examine_mesh(moved(ball(), {5, 0, 0})).problem(), "") << "far from the origin";
}

TEST(examine_mesh, two_cubes_that_cross_are_reported_with_a_place) {
  const TriangleMesh mesh = cube() + moved(cube(), {1.1, 1.2, 1.3});
  const MeshReport report = examine_mesh(mesh);
  EXPECT_TRUE(check_mesh(mesh).is_solid()) << "edges alone do not tell";
  EXPECT_GT(report.crossings, 0u);
  EXPECT_EQ(report.shells, 2u);
  // A crossing lies on the surface of both cubes.
  const auto on_surface = [&](const Vec3& middle) {
    const Vec3 d = report.crossing_at - middle;
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  };
  EXPECT_NEAR(on_surface({0, 0, 0}), 1.0, 1e-12);
  EXPECT_NEAR(on_surface({1.1, 1.2, 1.3}), 1.0, 1e-12);
  expect_says(mesh, "passes through itself");
}

TEST(examine_mesh, crossings_do_not_hide_in_common_planes_and_edges) {
  EXPECT_GT(examine_mesh(cube() + moved(cube(), {1, 0, 0})).crossings, 0u) << "four common planes";
  EXPECT_GT(examine_mesh(cube() + moved(cube(), {1, 1, 0})).crossings, 0u) << "two common planes";
  // The upper plane of the plate cuts the octahedron exactly along its equator, which is made of edges.
  TriangleMesh octahedron;
  octahedron.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    octahedron.triangles.push_back({i, (i + 1) % 4, 4});
    octahedron.triangles.push_back({(i + 1) % 4, i, 5});
  }
  ASSERT_EQ(examine_mesh(octahedron).problem(), "");
  const TriangleMesh plate = moved(box_mesh({3, 3, 2}), {0.1, 0.2, -2});
  EXPECT_GT(examine_mesh(plate + octahedron).crossings, 0u);
}

TEST(examine_mesh, bodies_that_touch_do_not_cross) {
  const MeshReport stacked = examine_mesh(cube() + moved(cube(0.5), {0.1, 0.2, 1.5}));
  EXPECT_EQ(stacked.problem(), "");
  EXPECT_EQ(stacked.shells, 2u);
}

TEST(examine_mesh, crossing_of_random_hulls_is_seen_and_distance_is_not) {
  testing_random::Random random{11};
  for (int i = 0; i < 30; ++i) {
    TriangleMesh a = ball(), b = ball();
    const Vec3 way = random.direction();
    // Both are within 1 mm of their centres and contain the balls of 0.9 mm about them.
    EXPECT_GT(examine_mesh(a + moved(b, 1.7e-3 * way)).crossings, 0u);
    EXPECT_EQ(examine_mesh(a + moved(b, 2.01e-3 * way)).problem(), "");
  }
}

TEST(examine_mesh, a_cube_with_a_flipped_face_is_reported) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  const MeshReport report = examine_mesh(mesh);
  EXPECT_EQ(report.misoriented_edges, 4u) << "the rim of the face";
  EXPECT_FALSE(report.one_sided);
  expect_says(mesh, "unify the normals");
}

TEST(examine_mesh, a_moebius_strip_has_one_side_and_a_full_twist_has_two) {
  const MeshReport moebius = examine_mesh(strip(40, 1));
  EXPECT_TRUE(moebius.one_sided);
  EXPECT_GT(moebius.open_edges, 0u);
  EXPECT_EQ(moebius.euler, 0);
  ASSERT_EQ(moebius.problems().size(), 2u);
  EXPECT_NE(moebius.problems()[1].find("Moebius"), std::string::npos);
  EXPECT_FALSE(examine_mesh(strip(40, 0)).one_sided);
  EXPECT_FALSE(examine_mesh(strip(40, 2)).one_sided);
}

TEST(examine_mesh, a_triangle_without_area_is_reported) {
  TriangleMesh mesh = cube();
  mesh.vertices.push_back({0, -1, -1});  // on the edge from corner 0 to corner 1, with a sliver below it
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_EQ(examine_mesh(mesh).degenerate_triangles, 1u);
  expect_says(mesh, "1 triangle has no area");
}

TEST(examine_mesh, a_sphere_inside_out_is_reported) {
  const TriangleMesh mesh = turned_inside_out(ball());
  EXPECT_TRUE(examine_mesh(mesh).inside_out);
  expect_says(mesh, "inside out");
}

TEST(examine_mesh, shells_inside_shells_must_alternate) {
  EXPECT_EQ(examine_mesh(cube(3) + turned_inside_out(cube(2))).problem(), "") << "a hollow cube";
  EXPECT_EQ(examine_mesh(cube(3) + turned_inside_out(cube(2)) + cube(1)).problem(), "") << "with a cube in it";
  EXPECT_EQ(examine_mesh(cube(3) + cube(2)).misplaced_shells, 1u);
  EXPECT_EQ(examine_mesh(cube(1) + moved(turned_inside_out(cube(0.5)), {5, 0, 0})).misplaced_shells, 1u);
  expect_says(cube(3) + cube(2), "1 of 2 shells");
}

TEST(examine_mesh, a_plate_of_two_triangles_back_to_back_lies_on_itself) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(examine_mesh(mesh).crossings, 1u);
  EXPECT_FALSE(examine_mesh(mesh).is_solid());
}

TEST(examine_mesh, survives_any_soup) {
  // Random triangles with random corners of few points: all faults at once, and a count that ends.
  testing_random::Random random{5};
  TriangleMesh mesh;
  for (int i = 0; i < 60; ++i) mesh.vertices.push_back(random.in_box({-1, -1, -1}, {1, 1, 1}));
  for (int i = 0; i < 3000; ++i) {
    const auto any = [&] { return static_cast<std::uint32_t>(random.uniform(0, 60)); };
    mesh.triangles.push_back({any(), any(), any()});
  }
  const MeshReport report = examine_mesh(mesh);
  EXPECT_EQ(report.crossings, kMostCrossings);
  EXPECT_GT(report.crowded_edges, 0u);
  EXPECT_FALSE(report.is_solid());
  EXPECT_TRUE(is_finite(report.crossing_at));
}

}  // namespace
}  // namespace scree
