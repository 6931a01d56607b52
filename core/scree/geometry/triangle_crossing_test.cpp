#include "scree/geometry/triangle_crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scree/geometry/testing_random.hpp"

namespace scree {
namespace {

constexpr double kTolerance = 1e-9;  // of triangles of size one; above rounding by six orders
constexpr TriangleCorners kFloor{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

bool crosses(const TriangleCorners& a, const TriangleCorners& b) {
  const bool one = crossing_of(a, b, kTolerance).has_value(), other = crossing_of(b, a, kTolerance).has_value();
  EXPECT_EQ(one, other) << "the order of two triangles decides";
  return one;
}

TEST(crossing_of, a_triangle_that_pierces_another_crosses_it_at_a_point_of_both) {
  const TriangleCorners blade{{{0.25, 0.25, -1}, {0.3, 0.25, 1}, {0.2, 0.25, 1}}};
  const auto at = crossing_of(kFloor, blade, kTolerance);
  ASSERT_TRUE(at.has_value());
  EXPECT_NEAR(at->z, 0.0, 1e-14);  // in the plane of the floor and of the blade, up to rounding
  EXPECT_NEAR(at->y, 0.25, 1e-14);
  EXPECT_NEAR(at->x, 0.25, 0.05);
  EXPECT_TRUE(crosses(kFloor, blade));
}

TEST(crossing_of, touching_is_no_crossing) {
  EXPECT_FALSE(crosses(kFloor, {{{0.2, 0.2, 0}, {0.3, 0.2, 1}, {0.2, 0.3, 1}}})) << "corner on the face";
  EXPECT_FALSE(crosses(kFloor, {{{0.2, 0.2, 0}, {0.3, 0.2, 0}, {0.2, 0.3, 1}}})) << "edge on the face";
  EXPECT_FALSE(crosses(kFloor, {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}})) << "common edge";
  EXPECT_FALSE(crosses(kFloor, {{{0, 0, 0}, {-1, 0.5, 1}, {-1, -0.5, -1}}})) << "common corner";
}

TEST(crossing_of, cut_planes_are_not_enough) {
  // Both planes are cut, but the pieces of the common line lie apart.
  EXPECT_FALSE(crosses(kFloor, {{{2, 0.25, -1}, {2.1, 0.25, 1}, {1.9, 0.25, 1}}}));
}

TEST(crossing_of, a_common_corner_does_not_hide_a_crossing) {
  EXPECT_TRUE(crosses(kFloor, {{{0, 0, 0}, {1, 1, 0.5}, {1, 1, -0.5}}}));
}

TEST(crossing_of, triangles_of_one_plane_cross_when_they_overlap_and_face_the_same_way) {
  const TriangleCorners over{{{0.1, 0.1, 0}, {1.1, 0.1, 0}, {0.1, 1.1, 0}}};
  EXPECT_TRUE(crosses(kFloor, over));
  EXPECT_FALSE(crosses(kFloor, {{over[0], over[2], over[1]}})) << "two bodies that touch along a face";
  EXPECT_FALSE(crosses(kFloor, {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}})) << "neighbours in a flat face";
}

TEST(crossing_of, what_has_no_area_crosses_nothing) {
  EXPECT_FALSE(crosses(kFloor, {{{0.2, 0.2, -1}, {0.2, 0.2, 0}, {0.2, 0.2, 1}}}));
}

/// Independent of planes: some side of one triangle passes through the inside of the other, by volumes of tetrahedra.
bool side_pierces(const TriangleCorners& sides, const TriangleCorners& face) {
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return dot(b - a, cross(c - a, d - a));
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &p = sides[k], &q = sides[(k + 1) % 3];
    const bool apart = volume(face[0], face[1], face[2], p) * volume(face[0], face[1], face[2], q) < 0.0;
    const double u = volume(p, q, face[0], face[1]), v = volume(p, q, face[1], face[2]),
                 w = volume(p, q, face[2], face[0]);
    if (apart && u * v > 0.0 && v * w > 0.0) return true;
  }
  return false;
}

TEST(crossing_of, agrees_with_sides_that_pierce_faces_for_random_triangles) {
  // Two triangles in general position cross exactly when a side of one pierces the other.
  testing_random::Random random{7};
  int crossing = 0;
  constexpr int kPairs = 20000;
  for (int i = 0; i < kPairs; ++i) {
    TriangleCorners a{}, b{};
    for (Vec3& p : a) p = random.in_box({0, 0, 0}, {1, 1, 1});
    for (Vec3& p : b) p = random.in_box({0, 0, 0}, {1, 1, 1});
    const bool expected = side_pierces(a, b) || side_pierces(b, a);
    EXPECT_EQ(crosses(a, b), expected) << "pair " << i;
    crossing += expected ? 1 : 0;
  }
  EXPECT_GT(crossing, kPairs / 20);
  EXPECT_LT(crossing, kPairs / 2);
}

TEST(is_folded, neighbours_that_lie_on_each_other_are_folded_and_flat_ones_are_not) {
  EXPECT_TRUE(is_folded(kFloor, {0.9, 0.8, 0}, kTolerance));
  EXPECT_FALSE(is_folded(kFloor, {0.5, -1, 0}, kTolerance));
  EXPECT_FALSE(is_folded(kFloor, {0.5, 0.5, 0.01}, kTolerance)) << "a sharp edge";
}

TEST(edge_crossing_of, a_surface_can_pass_through_a_face_along_its_own_edge) {
  const std::array<Vec3, 2> edge{Vec3{0.1, 0.2, 0}, Vec3{0.5, 0.2, 0}};
  EXPECT_TRUE(edge_crossing_of(kFloor, edge, {0.3, 0.2, 1}, {0.3, 0.3, -1}, kTolerance).has_value());
  EXPECT_FALSE(edge_crossing_of(kFloor, edge, {0.3, 0.2, 1}, {0.3, 0.3, 1}, kTolerance).has_value()) << "stands on it";
  const std::array<Vec3, 2> outside{Vec3{0, -0.2, 0}, Vec3{1, -0.2, 0}};
  EXPECT_FALSE(edge_crossing_of(kFloor, outside, {0.3, 0.2, 1}, {0.3, 0.3, -1}, kTolerance).has_value());
  const std::array<Vec3, 2> rim{Vec3{0.1, 0, 0}, Vec3{0.9, 0, 0}};
  EXPECT_FALSE(edge_crossing_of(kFloor, rim, {0.3, 0, 1}, {0.3, 0, -1}, kTolerance).has_value()) << "along the rim";
}

}  // namespace
}  // namespace scree
