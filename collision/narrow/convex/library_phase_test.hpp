// LibraryPhase: what every narrow phase around a collision library holds, against closed forms. The suite over all pairs of
// kinds is in tests/narrow_phases.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/geometry/triangle_mesh_data.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree::test {

template <class Phase>
class LibraryPhase : public testing::Test {
 protected:
  Phase phase_;
};
TYPED_TEST_SUITE_P(LibraryPhase);

// Two cubes of edge 2, a face apart and one pushed in: four points, each of the exact gap.
TYPED_TEST_P(LibraryPhase, boxes_meet_in_four_points) {
  PairScene scene{primitive_data(ShapeKind::box, {1, 1, 1}), primitive_data(ShapeKind::box, {1, 1, 1})};
  for (const double gap : {0.01, -0.01}) {
    const ContactBuffer contacts = scene.collide(this->phase_, {}, {{0.5, 0.25, 2 + gap}, {}}, 0.1);
    ASSERT_EQ(contacts.size(), 4u);
    for (const Contact& c : contacts) {
      EXPECT_NEAR(c.gap, gap, 1e-12);  // rounding of numbers near one
      EXPECT_NEAR(c.normal.z, 1.0, 1e-12);
      EXPECT_NEAR(c.point.z, 1 + 0.5 * gap, 1e-12);
    }
  }
  EXPECT_EQ(this->phase_.fallbacks(), 0u);
}

// An upright cylinder of radius 1 on a large box: its twelve-sided rim gives eight points at most, the cylinder's foot.
TYPED_TEST_P(LibraryPhase, an_upright_cylinder_stands_on_points_of_its_rim) {
  PairScene scene{primitive_data(ShapeKind::box, {10, 10, 1}), primitive_data(ShapeKind::cylinder, {1, 2, 0})};
  const ContactBuffer contacts = scene.collide(this->phase_, {}, {{3, 0, 2.999}, {}}, 0.01);
  ASSERT_GE(contacts.size(), 4u);
  ASSERT_LE(contacts.size(), 8u);
  Vec3 mean;
  for (const Contact& c : contacts) {
    EXPECT_NEAR(c.gap, -0.001, 1e-12);
    EXPECT_NEAR(std::hypot(c.point.x - 3, c.point.y), 1.0, 1e-9);
    mean += c.point / static_cast<double>(contacts.size());
  }
  EXPECT_LT(std::hypot(mean.x - 3, mean.y), 0.5) << "they hold it from all sides";
}

// A mesh of a flat floor gives no sideways push at its inner edges, wherever the box stands.
TYPED_TEST_P(LibraryPhase, a_flat_mesh_pushes_straight_up) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t j = 0; j < 5; ++j) {
    for (std::uint32_t i = 0; i < 5; ++i) vertices.push_back({i - 2.0, j - 2.0, 0.0});
  }
  for (std::uint32_t j = 0; j < 4; ++j) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t k = 5 * j + i;
      triangles.push_back({k, k + 1, k + 6});
      triangles.push_back({k, k + 6, k + 5});
    }
  }
  PairScene scene{mesh_data(vertices, triangles), primitive_data(ShapeKind::box, {0.4, 0.3, 0.2})};
  for (int k = 0; k < 40; ++k) {
    const Vec3 at{0.05 * k - 1.0, 0.03 * k - 0.5, 0.199};
    const ContactBuffer contacts = scene.collide(this->phase_, {}, {at, {}}, 0.01);
    ASSERT_FALSE(contacts.empty());
    for (const Contact& c : contacts) {
      EXPECT_NEAR(c.normal.z, 1.0, 1e-9) << "step " << k;
      EXPECT_NEAR(c.gap, -0.001, 1e-9);
    }
  }
}

/// How far a solid with half axes, or radius and half length, reaches along d.
inline double reach_along(ShapeKind kind, const Vec3& size, const Vec3& d) {
  const double across = size.x * std::hypot(d.x, d.y), along = size.y * d.z;
  if (kind == ShapeKind::cylinder) return across + std::abs(along);
  if (kind == ShapeKind::capsule) return size.x + std::abs(along);
  if (kind == ShapeKind::cone) return std::max(along, across - along);
  if (kind == ShapeKind::ellipsoid) return norm(hadamard(size, d));
  if (kind == ShapeKind::sphere) return size.x;
  return dot(size, {std::abs(d.x), std::abs(d.y), std::abs(d.z)});  // a box, or the corners of one
}

// Law: a solid whose middle lies inside of a closed mesh is led out through the wall nearest to that, by its depth below it,
// whether it cuts that wall or not.
TYPED_TEST_P(LibraryPhase, what_is_inside_of_a_mesh_is_led_out) {
  RandomNumbers random{8};
  const Vec3 half{3, 4, 5}, size{0.5, 0.4, 0.3};
  const TriangleMesh walls = box_mesh(half);
  for (int trial = 0; trial < 200; ++trial) {
    for (const ShapeKind kind : {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid, ShapeKind::capsule,
                                 ShapeKind::box, ShapeKind::sphere, ShapeKind::triangle_mesh}) {
      PrimitiveData solid = primitive_data(kind, size);
      if (kind == ShapeKind::triangle_mesh) solid = mesh_data(box_mesh(size).vertices, box_mesh(size).triangles);
      PairScene scene{mesh_data(walls.vertices, walls.triangles), solid};
      const Pose mesh = random.pose(1.0);
      const Pose inside{{random.uniform(-2, 2), random.uniform(-3, 3), random.uniform(-4.9, 4.9)}, random.rotation()};
      const ContactBuffer contacts = scene.collide(this->phase_, mesh, mesh * inside, 0.01);
      int axis = 0;
      for (int i = 1; i < 3; ++i) {
        if (half[i] - std::abs(inside.position[i]) < half[axis] - std::abs(inside.position[axis])) axis = i;
      }
      Vec3 out;
      out[axis] = std::copysign(1.0, inside.position[axis]);
      const double depth =
          half[axis] - std::abs(inside.position[axis]) + reach_along(kind, size, rotate_back(inside.orientation, -out));
      ASSERT_FALSE(contacts.empty()) << to_string(kind) << ", trial " << trial;
      const auto deepest = std::ranges::min_element(contacts, {}, &Contact::gap);
      EXPECT_NEAR(deepest->gap, -depth, 1e-12) << to_string(kind) << ", trial " << trial;
      for (const Contact& c : contacts) EXPECT_LT(norm(c.normal - rotate(mesh.orientation, out)), 1e-12);
      for (std::size_t k = 1; k < contacts.size(); ++k) EXPECT_LT(contacts[k - 1].feature, contacts[k].feature);
    }
  }
  // The other order of the two; and what floats in a hollow of the mesh touches nothing.
  PairScene scene{primitive_data(ShapeKind::cone, size), mesh_data(walls.vertices, walls.triangles)};
  const ContactBuffer other = scene.collide(this->phase_, {{0, 0, 4}, {}}, {}, 0.01);
  ASSERT_FALSE(other.empty());
  EXPECT_NEAR(other[0].normal.z, -1.0, 1e-12) << "from the cone to the mesh";
  const TriangleMesh hollow = box_mesh({1, 1, 1});
  std::vector<Vec3> vertices = walls.vertices;
  std::vector<Triangle> triangles = walls.triangles;
  for (const Triangle& t : hollow.triangles) triangles.push_back({t[0] + 8, t[2] + 8, t[1] + 8});
  vertices.insert(vertices.end(), hollow.vertices.begin(), hollow.vertices.end());
  PairScene floating{mesh_data(vertices, triangles), primitive_data(ShapeKind::cone, size)};
  EXPECT_TRUE(floating.collide(this->phase_, {}, {}, 0.01).empty());
}

TYPED_TEST_P(LibraryPhase, a_drum_is_refused) {
  PairScene scene{primitive_data(ShapeKind::cylinder, {1, 1, 0}, true),
                  primitive_data(ShapeKind::box, {0.1, 0.1, 0.1})};
  EXPECT_THROW(static_cast<void>(scene.collide(this->phase_, {}, {}, 0.1)), Error);
}

REGISTER_TYPED_TEST_SUITE_P(LibraryPhase, boxes_meet_in_four_points, an_upright_cylinder_stands_on_points_of_its_rim,
                            a_flat_mesh_pushes_straight_up, what_is_inside_of_a_mesh_is_led_out, a_drum_is_refused);

}  // namespace scree::test
