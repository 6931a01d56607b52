#include "drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "scree/parallel/executor.hpp"

namespace scree::dem {
namespace {

constexpr double kLimit = 1.0;
constexpr double kFar = 1e3;

/// 5000 balls of which each test moves the last, in several chunks of work.
struct Crowd {
  Crowd() {
    slots.place.resize(5000), slots.moving.resize(5000), slots.body.resize(5000);
    std::iota(slots.body.begin(), slots.body.end(), BodyIndex{0});
    drift.begin(slots, kFar, executor);
  }
  /// Moves the last ball to x by `way` in the time h.
  bool goes(double x, double way, double h = 1e-9) {
    slots.place.back().position.x = x;
    return drift.exceeds(kLimit, h, way, slots, executor);
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
  crowd.drift.begin(crowd.slots, kFar, crowd.executor);
  EXPECT_FALSE(crowd.goes(-2.0, 0.99));
  EXPECT_TRUE(crowd.goes(-2.02, 0.02));
}

// Law: the fall under gravity from a place and a speed that were seen is g t^2 / 2 from what is expected, at any speed.
TEST(drift, of_a_ball_that_falls_is_what_gravity_adds_to_its_speed) {
  constexpr double kGravity = 2.0, kSpeed = 50.0, kStep = 1.0 / 64;
  Crowd crowd;
  Vec3& velocity = crowd.slots.moving.back().linear;
  velocity = {kSpeed, 0, 0};
  const auto steps_of_a_list = [&] {
    const double speed = velocity.x, from = crowd.slots.place.back().position.x;
    for (int k = 1;; ++k) {
      const double t = k * kStep;
      velocity.x = speed + kGravity * t;
      const bool over = crowd.goes(from + speed * t + 0.5 * kGravity * t * t, kStep * velocity.x, kStep);
      if (!over) continue;
      crowd.drift.begin(crowd.slots, kFar, crowd.executor);
      return k;
    }
  };
  EXPECT_EQ(steps_of_a_list(), 2) << "of the first list nothing is expected, and 50 / 64 a step are soon 1";
  int steps = 0;
  for (int list = 0; list < 6; ++list) steps = steps_of_a_list();
  EXPECT_EQ(steps, 65) << "g t^2 / 2 exceeds 1 after 1 s";
}

TEST(drift, a_ball_that_turns_back_is_expected_to_stay) {
  Crowd crowd;
  Vec3& velocity = crowd.slots.moving.back().linear;
  velocity = {10.0, 0, 0};
  EXPECT_TRUE(crowd.goes(1.01, 1.01, 0.1));
  crowd.drift.begin(crowd.slots, kFar, crowd.executor);
  EXPECT_NE(crowd.drift.expected(0.0).velocity.back(), Vec3{}) << "it went on as seen";
  velocity = {-10.0, 0, 0};
  EXPECT_TRUE(crowd.goes(0.9, 2.0, 0.2)) << "3 were expected";
  crowd.drift.begin(crowd.slots, kFar, crowd.executor);
  EXPECT_EQ(crowd.drift.expected(0.0).velocity.back(), Vec3{});
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(crowd.goes(k % 2 == 0 ? 0.4 : 1.2, 0.8)) << k;
}

TEST(drift, nobody_is_expected_to_go_farther_than_asked) {
  Crowd crowd;
  crowd.slots.moving.back().linear = {0, 0, 8.0};
  EXPECT_FALSE(crowd.goes(0.0, 0.5, 100.0));
  crowd.drift.forget();
  crowd.drift.begin(crowd.slots, 2.0, crowd.executor);
  EXPECT_EQ(crowd.drift.expected(0.5).horizon, 0.25);
  EXPECT_EQ(crowd.drift.expected(0.5).skin, 0.5);
}

// Of a body that turns by an angle a, a point at the distance r goes by the chord 2 r sin(a / 2).
TEST(drift, of_a_body_that_turns_is_that_of_its_farthest_point) {
  Crowd crowd;
  const double reach = 3.0, angle = 2.0 * std::asin(0.5 * kLimit / reach);
  crowd.slots.turning.push_back({.slot = 4000});
  crowd.slots.reach.push_back(reach);
  crowd.drift.begin(crowd.slots, kFar, crowd.executor);
  const auto turns_to = [&](double a) {
    crowd.slots.turning[0].orientation = {std::cos(0.5 * a), 0.0, std::sin(0.5 * a), 0.0};
    return crowd.drift.exceeds(kLimit, 1e-9, 10.0, crowd.slots, crowd.executor);
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
