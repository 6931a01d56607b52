// Boxes, hulls and capsules against triangle meshes.
#include <gtest/gtest.h>

#include <algorithm>

#include "polyhedron.hpp"
#include "support/trials.hpp"
#include "testing_difference.hpp"
#include "testing_solids.hpp"

namespace scree {
namespace {

using namespace test;

/// A grid of 2 n^2 triangles over the parallelogram at `corner` with sides u and v; the normal is u x v.
void add_patch(TriangleMesh& mesh, const Vec3& corner, const Vec3& u, const Vec3& v, int n) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) mesh.vertices.push_back(corner + (1.0 * i / n) * u + (1.0 * j / n) * v);
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      // Diagonals both ways.
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      } else {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
}

/// A floor at z = 0, |x|, |y| <= 4.
TriangleMesh floor_mesh(int n) {
  TriangleMesh mesh;
  add_patch(mesh, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, n);
  return mesh;
}

/// A closed box of half edges h, each face of 2 n^2 triangles.
TriangleMesh fine_box(const Vec3& h, int n) {
  TriangleMesh mesh;
  const Vec3 x{2 * h.x, 0, 0}, y{0, 2 * h.y, 0}, z{0, 0, 2 * h.z};
  add_patch(mesh, -h, y, x, n);
  add_patch(mesh, -h, z, y, n);
  add_patch(mesh, -h, x, z, n);
  add_patch(mesh, h, -x, -y, n);
  add_patch(mesh, h, -y, -z, n);
  add_patch(mesh, h, -z, -x, n);
  // Rounding of the same place from two faces.
  return welded(mesh, 1e-9);
}

/// The contacts of a solid at `pose` on a mesh that is body 0.
ContactBuffer on_mesh(const TriangleMesh& mesh, const Solid& solid, const Pose& mesh_pose, const Pose& pose,
                      double reach) {
  PairScene scene{mesh_data(mesh.vertices, mesh.triangles), solid.data};
  Polyhedron phase;
  return scene.collide(phase, mesh_pose, pose, reach);
}

double least_gap(const ContactBuffer& contacts) {
  double gap = 1e300;
  for (const Contact& c : contacts) gap = std::min(gap, c.gap);
  return gap;
}

// Law: on a flat mesh, fine or coarse, a box touches as on a plane: normals are the plane's, gaps are heights, and its
// lower corners, where within reach, are all there.
TEST(MeshContacts, flat_mesh_is_a_plane) {
  RandomNumbers random{1};
  const Solid box = box_solid({0.5, 0.4, 0.3});
  for (const int n : {1, 4, 16}) {
    const TriangleMesh floor = floor_mesh(n);
    for (int trial = 0; trial < trials(100); ++trial) {
      const Quat tilt = from_rotation_vector(random.decades(1e-9, 1e-3) * random.direction());
      const Pose pose{{random.uniform(-2, 2), random.uniform(-2, 2), 0.3 + random.uniform(-2e-3, 2e-3)},
                      tilt * from_rotation_vector({0, 0, random.uniform(0, 6)})};
      const ContactBuffer contacts = on_mesh(floor, box, {}, pose, 2e-3);
      std::vector<Vec3> corners;
      for (const Vec3& c : box.placed(pose)) {
        if (c.z < 1.9e-3) corners.push_back(c);
      }
      EXPECT_LE(contacts.size(), 8u);
      for (const Contact& c : contacts) {
        // Rounding of coordinates up to 4.
        EXPECT_LT(norm(c.normal - Vec3{0, 0, 1}), 1e-14);
        EXPECT_NEAR(c.point.z, 0.5 * c.gap, 1e-12);
      }
      for (const Vec3& corner : corners) {
        EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(),
                                [&](const Contact& c) {
                                  return std::hypot(c.point.x - corner.x, c.point.y - corner.y) < 1e-4 &&
                                         std::abs(c.gap - corner.z) < 1e-6;
                                }))
            << "corner " << corner.x << " " << corner.y << " " << corner.z << ", n = " << n;
      }
    }
  }
}

// Law: the same for a capsule that lies down: two points; and for a mesh that is body b, with the normal turned round.
TEST(MeshContacts, capsule_lies_on_two_points) {
  RandomNumbers random{2};
  const Solid rod = capsule_solid(0.1, 0.4);
  const TriangleMesh floor = floor_mesh(16);
  for (int trial = 0; trial < trials(100); ++trial) {
    const Quat lying = from_rotation_vector({0, 0, random.uniform(0, 6)}) * rotation_between({0, 0, 1}, {1, 0, 0});
    const Pose pose{{random.uniform(-2, 2), random.uniform(-2, 2), 0.1 - 1e-4}, lying};
    PairScene scene{rod.data, mesh_data(floor.vertices, floor.triangles)};
    Polyhedron phase;
    const ContactBuffer contacts = scene.collide(phase, pose, {}, 1e-3);
    ASSERT_GE(contacts.size(), 2u);
    EXPECT_LE(contacts.size(), 3u);
    double span = 0.0;
    for (const Contact& c : contacts) {
      EXPECT_LT(norm(c.normal - Vec3{0, 0, -1}), 1e-9);
      EXPECT_NEAR(c.gap, -1e-4, 1e-12);
      for (const Contact& other : contacts) span = std::max(span, norm(c.point - other.point));
    }
    EXPECT_NEAR(span, 0.8, 1e-4);
  }
}

class ClosedMesh : public testing::TestWithParam<std::string> {};

// Law: a box as a mesh, of 12 or of 600 triangles, and a box in closed form are the same solid, apart and in shallow
// overlap: gap and normal are those of the difference of two convex solids.
TEST_P(ClosedMesh, box_of_triangles_is_a_box) {
  RandomNumbers random{3};
  const Solid box = box_solid({0.6, 0.5, 0.4});
  int apart = 0, overlapping = 0;
  for (int trial = 0; trial < trials(150); ++trial) {
    const Solid solid = GetParam() == "box"       ? box_solid({0.3, 0.2, 0.25})
                        : GetParam() == "capsule" ? capsule_solid(0.15, 0.3)
                                                  : random_hull(random, 14, 0.4);
    const TriangleMesh mesh = trial % 2 == 0 ? box_mesh({0.6, 0.5, 0.4}) : fine_box({0.6, 0.5, 0.4}, 5);
    const Pose mesh_pose = random.pose(1.0);
    Pose pose{mesh_pose.position + 2.0 * random.direction(), random.rotation()};
    // Along the normal of the closed form, to where the gap is wanted.
    PairScene scene{box.data, solid.data};
    Polyhedron convex;
    const ContactBuffer far = scene.collide(convex, mesh_pose, pose, 10.0);
    ASSERT_FALSE(far.empty());
    const double wanted = (trial % 3 == 0 ? -1.0 : 1.0) * random.decades(1e-6, 2e-2);
    pose.position += (wanted - least_gap(far)) * far[0].normal;
    const auto at_a = box.placed(mesh_pose), at_b = solid.placed(pose);
    const double gap = reference_gap(at_a, at_b) - solid.radius;
    const ContactBuffer contacts = on_mesh(mesh, solid, mesh_pose, pose, 0.05);
    ASSERT_FALSE(contacts.empty());
    // Faces are preferred to edges that are better by up to 1e-4 of the size.
    EXPECT_NEAR(least_gap(contacts), gap, 2e-4) << "trial " << trial;
    const auto nearest = std::min_element(contacts.begin(), contacts.end(),
                                          [](const Contact& l, const Contact& r) { return l.gap < r.gap; });
    EXPECT_NEAR(separation_along(nearest->normal, at_a, at_b) - solid.radius, gap, 2e-4) << "trial " << trial;
    EXPECT_LE(contacts.size(), 12u);
    apart += gap > 0.0;
    overlapping += gap < 0.0;
  }
  EXPECT_GT(apart, 20);
  EXPECT_GT(overlapping, 20);
}

INSTANTIATE_TEST_SUITE_P(solids, ClosedMesh, testing::Values("box", "hull", "capsule"),
                         [](const auto& chosen) { return chosen.param; });

// Law: the rim of a sheet is an edge: a box beside it is pushed away sideways, also where the sheet goes on in triangles.
TEST(MeshContacts, rim_is_an_edge) {
  const Solid box = box_solid({0.5, 0.5, 0.5});
  const TriangleMesh floor = floor_mesh(8);
  const ContactBuffer contacts = on_mesh(floor, box, {}, {{4.51, 0, 0.1}, {}}, 0.02);
  ASSERT_FALSE(contacts.empty());
  for (const Contact& c : contacts) {
    EXPECT_LT(norm(c.normal - Vec3{1, 0, 0}), 1e-9);
    EXPECT_NEAR(c.gap, 0.01, 1e-12);
  }
}

// Law: in a valley a box touches both sides, on a ridge its crest only.
TEST(MeshContacts, valley_has_two_sides_and_ridge_one_crest) {
  for (const double slope : {0.5, -0.5}) {
    TriangleMesh mesh;
    add_patch(mesh, {-2, -2, 2 * slope}, {2, 0, -2 * slope}, {0, 4, 0}, 7);
    add_patch(mesh, {0, -2, 0}, {2, 0, 2 * slope}, {0, 4, 0}, 7);
    mesh = welded(mesh, 1e-9);
    if (slope < 0.0) {
      const Solid box = box_solid({0.5, 0.4, 0.3});
      const ContactBuffer crest = on_mesh(mesh, box, {}, {{0.1, 0.2, 0.299}, {}}, 1e-3);
      ASSERT_GE(crest.size(), 2u);
      for (const Contact& c : crest) {
        EXPECT_LT(norm(c.normal - Vec3{0, 0, 1}), 1e-9);
        EXPECT_NEAR(c.gap, -1e-3, 1e-9);
        EXPECT_NEAR(c.point.x, 0.0, 1e-9);
      }
    } else {
      // The lower edges of the box, at +-0.3, on slopes of 1 to 2.
      const Solid box = box_solid({0.3, 0.4, 0.3});
      const ContactBuffer sides = on_mesh(mesh, box, {}, {{0, 0.2, 0.45}, {}}, 1e-3);
      int left = 0, right = 0;
      for (const Contact& c : sides) {
        EXPECT_NEAR(std::abs(c.normal.x), 0.5 / std::hypot(1.0, 0.5), 1e-9);
        EXPECT_NEAR(c.gap, 0.0, 1e-9);
        EXPECT_NEAR(std::abs(c.point.x), 0.3, 1e-9);
        (c.normal.x > 0.0 ? left : right) += 1;
      }
      EXPECT_GE(left, 2);
      EXPECT_GE(right, 2);
    }
  }
}

// Law: a solid that has gone whole into a closed mesh is led out: through the wall nearest to its middle, by its depth below that
// wall.
TEST(MeshContacts, what_is_inside_is_led_out) {
  RandomNumbers random{6};
  const Vec3 half{3, 4, 5};
  for (int trial = 0; trial < trials(100); ++trial) {
    const Solid solid = trial % 2 == 0 ? box_solid({0.3, 0.2, 0.25}) : capsule_solid(0.15, 0.3);
    const TriangleMesh mesh = trial % 4 < 2 ? box_mesh(half) : fine_box(half, 5);
    const Pose mesh_pose = random.pose(1.0);
    // The middle is a mesh vertex's or edge's own coordinate in one trial of three.
    Vec3 at{random.uniform(-2, 2), random.uniform(-3, 3), random.uniform(-4, 4)};
    if (trial % 3 == 0) at.y = at.z = 0.0;
    const Pose inside{at, random.rotation()};
    const ContactBuffer contacts = on_mesh(mesh, solid, mesh_pose, mesh_pose * inside, 0.01);
    ASSERT_EQ(contacts.size(), 1u) << "trial " << trial;
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (half[i] - std::abs(at[i]) < half[axis] - std::abs(at[axis])) axis = i;
    }
    const double side = at[axis] < 0.0 ? -1.0 : 1.0;
    double lowest = 1e300;
    for (const Vec3& c : solid.placed(inside)) lowest = std::min(lowest, side * c[axis]);
    EXPECT_NEAR(contacts[0].gap, lowest - solid.radius - half[axis], 1e-12);
    Vec3 out;
    out[axis] = side;
    EXPECT_LT(norm(contacts[0].normal - rotate(mesh_pose.orientation, out)), 1e-12);
  }
}

}  // namespace
}  // namespace scree
