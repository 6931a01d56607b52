#include "drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

constexpr double kLimit = 1.0;

/// 5000 balls of which each test moves the last, in several chunks of work.
struct Crowd {
  Crowd() {
    slots.body.resize(5000);
    slots.place.resize(5000);
    drift.begin(slots, executor);
  }
  /// Moves the last ball to x by `way`.
  bool goes(double x, double way) {
    slots.place.back().position.x = x;
    return drift.exceeds(kLimit, way, slots, executor);
  }
  Executor executor{2};
  Slots slots;
  Drift drift;
};

TEST(drift, a_ball_that_rattles_in_its_place_never_exceeds_a_limit_that_its_place_is_within) {
  Crowd crowd;
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(crowd.goes(k % 2 == 0 ? 0.4 : -0.4, 0.8)) << k;
}

TEST(drift, counts_from_where_bodies_were_at_the_beginning) {
  Crowd crowd;
  EXPECT_FALSE(crowd.goes(0.9, 0.9));
  EXPECT_FALSE(crowd.goes(-0.99, 1.89));
  EXPECT_TRUE(crowd.goes(-1.01, 0.02));
  crowd.drift.begin(crowd.slots, crowd.executor);
  EXPECT_FALSE(crowd.goes(-2.0, 0.99));
  EXPECT_TRUE(crowd.goes(-2.02, 0.02));
}

// Of a body that turns by an angle a, a point at the distance r goes by the chord 2 r sin(a / 2).
TEST(drift, of_a_body_that_turns_is_that_of_its_farthest_point) {
  Crowd crowd;
  const double reach = 3.0, angle = 2.0 * std::asin(0.5 * kLimit / reach);
  crowd.slots.turning.push_back({.slot = 4000});
  crowd.slots.reach.push_back(reach);
  crowd.drift.begin(crowd.slots, crowd.executor);
  const auto turns_to = [&](double a) {
    crowd.slots.turning[0].orientation = {std::cos(0.5 * a), 0.0, std::sin(0.5 * a), 0.0};
    return crowd.drift.exceeds(kLimit, 10.0, crowd.slots, crowd.executor);
  };
  EXPECT_FALSE(turns_to(0.999 * angle));
  EXPECT_FALSE(turns_to(-0.999 * angle));
  EXPECT_TRUE(turns_to(1.001 * angle));
}

TEST(drift, that_cannot_be_told_is_too_long) {
  Crowd crowd;
  EXPECT_TRUE(crowd.goes(0.0, std::numeric_limits<double>::quiet_NaN()));
  Crowd grown;
  grown.slots.body.emplace_back(), grown.slots.place.emplace_back();
  EXPECT_TRUE(grown.goes(0.0, 2.0));
  Crowd turned;
  turned.slots.turning.push_back({.slot = 4000});
  turned.slots.reach.push_back(1.0);
  EXPECT_TRUE(turned.goes(0.0, 2.0));
}

}  // namespace
}  // namespace scree::dem
