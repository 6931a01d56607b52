// LibraryPhase: what every narrow phase around a collision library holds, against closed forms. The suite over all pairs of
// kinds is in tests/narrow_phases.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scree/base/error.hpp"
#include "support/pair_scene.hpp"

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

TYPED_TEST_P(LibraryPhase, a_drum_is_refused) {
  PairScene scene{primitive_data(ShapeKind::cylinder, {1, 1, 0}, true),
                  primitive_data(ShapeKind::box, {0.1, 0.1, 0.1})};
  EXPECT_THROW(static_cast<void>(scene.collide(this->phase_, {}, {}, 0.1)), Error);
}

REGISTER_TYPED_TEST_SUITE_P(LibraryPhase, boxes_meet_in_four_points, an_upright_cylinder_stands_on_points_of_its_rim,
                            a_flat_mesh_pushes_straight_up, a_drum_is_refused);

}  // namespace scree::test
