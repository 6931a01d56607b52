#include "collector.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace scree {
namespace {

// 0.3 m x 0.2 m at y = -0.1 m; u x v points to -y: falling is forward.
Collector make(Direction direction = Direction::both) {
  return {{0.28, -0.1, -0.1}, {0.3, 0, 0}, {0, 0, 0.2}, 25, 4, direction};
}

TEST(collector, finds_the_point_where_the_segment_meets_the_plane) {
  const auto crossing = make().crossing({0.3, 0.1, 0.0}, {0.4, -0.3, 0.08});
  ASSERT_TRUE(crossing);
  // Half of the fall is above the plane: x = 0.35, z = 0.04. A dozen roundings of numbers of order one.
  EXPECT_NEAR(crossing->fraction, 0.5, 1e-14);
  EXPECT_NEAR(crossing->a, (0.35 - 0.28) / 0.3, 1e-14);
  EXPECT_NEAR(crossing->b, (0.04 + 0.1) / 0.2, 1e-14);
  EXPECT_EQ(make().bin(*crossing), 2 * 25 + 5);  // a = 0.2333 of 25 bins is bin 5, b = 0.7 of 4 is row 2
}

TEST(collector, ignores_steps_that_stay_on_one_side) {
  EXPECT_FALSE(make().crossing({0.3, 0.1, 0}, {0.3, -0.09, 0}));
  EXPECT_FALSE(make().crossing({0.3, -0.11, 0}, {0.3, -5, 0}));
}

TEST(collector, counts_only_the_direction_it_is_told) {
  const Vec3 above{0.3, 0, 0}, below{0.3, -0.2, 0};
  EXPECT_TRUE(make(Direction::forward).crossing(above, below));
  EXPECT_FALSE(make(Direction::forward).crossing(below, above));
  EXPECT_FALSE(make(Direction::backward).crossing(above, below));
  EXPECT_TRUE(make(Direction::backward).crossing(below, above));
  EXPECT_TRUE(make(Direction::both).crossing(below, above));
}

TEST(collector, sees_a_body_that_ends_a_step_exactly_on_the_plane_once) {
  const Vec3 above{0.3, 0, 0}, on{0.3, -0.1, 0}, below{0.3, -0.2, 0};
  EXPECT_TRUE(make().crossing(above, on));
  EXPECT_FALSE(make().crossing(on, below));
}

TEST(collector, bins_are_half_open_and_cover_the_rectangle_without_overlap) {
  const Collector c{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 4, 2, Direction::both};
  EXPECT_EQ(c.bin({0.0, 0.0, 0}), 0);
  EXPECT_EQ(c.bin({0.25, 0.0, 0}), 1);
  EXPECT_EQ(c.bin({0.999, 0.5, 0}), 7);
  EXPECT_EQ(c.bin({1.0, 0.0, 0}), -1);
  EXPECT_EQ(c.bin({-1e-12, 0.0, 0}), -1);
  EXPECT_EQ(c.bin({0.5, 1.0, 0}), -1);
}

TEST(collector, measures_along_its_edges_when_they_are_not_at_right_angles) {
  const Collector c{{1, 2, 3}, {2, 0, 0}, {1, 0, 3}, 10, 10, Direction::both};
  const Vec3 place = Vec3{1, 2, 3} + 0.35 * Vec3{2, 0, 0} + 0.75 * Vec3{1, 0, 3};
  const auto crossing = c.crossing(place + Vec3{0, 1, 0}, place - Vec3{0, 1, 0});
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(crossing->a, 0.35, 1e-14);
  EXPECT_NEAR(crossing->b, 0.75, 1e-14);
}

TEST(collector, refuses_parallel_edges) {
  EXPECT_THROW((Collector{{}, {1, 0, 0}, {-2, 0, 0}, 1, 1, Direction::both}), std::logic_error);
}

}  // namespace
}  // namespace scree
