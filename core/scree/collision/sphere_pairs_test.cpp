// Which pairs of spheres CollisionPipeline hands on, with and without boxes, against what spheres in motion can do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scree/collision/collision_pipeline.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree {
namespace {

using namespace test;

/// All pairs but those of planes.
class AllPairs : public BroadPhase {
 public:
  explicit AllPairs(bool balls_alone) : balls_alone_{balls_alone} {}
  [[nodiscard]] bool takes_balls_alone() const override { return balls_alone_; }
  void find_pairs(const BoxView& boxes, const Executor&, std::vector<CandidatePair>& out) override {
    const auto n = static_cast<ColliderIndex>(boxes.size());
    for (ColliderIndex i = 0; i < n; ++i) {
      for (ColliderIndex j = 0; j < i; ++j) {
        if (std::isfinite(boxes.ball[i].radius) && std::isfinite(boxes.ball[j].radius)) out.push_back({i, j});
      }
    }
  }

 private:
  bool balls_alone_;
};

/// A contact a pair, with the pair's reach as gap.
class Echo : public NarrowPhase {
 public:
  [[nodiscard]] bool supports(ShapeKind, ShapeKind) const override { return true; }
  void collide(const ColliderView& c, std::span<const ColliderPair> pairs, ContactBuffer& out) const override {
    for (const ColliderPair& p : pairs) out.push_back({c.body[p.a], c.body[p.b], 0, 0, 0, {}, {0, 0, 1}, p.reach});
  }
};

constexpr double kSlack = 1e-2, kDt = 0.02;

/// A few balls, some of which nothing moves, above a plane or alone.
struct Gas {
  ShapeSet shapes;
  BodyStore bodies;
  std::vector<double> radius;

  Gas(RandomNumbers& random, std::size_t count, bool all_movable, bool on_plane) {
    if (on_plane) {
      add(shape_data(plane_data()), {0, 0, -0.4}, {}, Motion::fixed);
      radius.push_back(0.0);
    }
    for (std::size_t i = 0; i < count; ++i) {
      radius.push_back(random.uniform(0.05, 0.1));
      const bool fixed = !all_movable && random.below(3) == 0;
      // Most are slow, so that both that touch and that come near are many.
      const double speed = random.below(4) == 0 ? 2.0 : 0.1;
      add(shape_data(sphere_data(radius.back())), random.in_cube(0.5), fixed ? Vec3{} : random.in_cube(speed),
          fixed ? Motion::fixed : Motion::dynamic);
    }
  }
  void add(const ShapeData& shape, const Vec3& at, const Vec3& velocity, Motion motion) {
    NewBody body;
    body.motion = motion;
    body.shape = shapes.add(shape);
    body.pose.position = at;
    body.velocity = velocity;
    bodies.add(body);
  }
  /// Reaches by pair.
  [[nodiscard]] std::map<std::pair<BodyIndex, BodyIndex>, double> pairs(bool balls_alone, int threads) const {
    AllPairs broad{balls_alone};
    Echo narrow;
    const Executor executor{threads};
    CollisionPipeline pipeline{shapes, broad, {&narrow}, executor, {kSlack}};
    const BodyView view = bodies.view();
    std::map<std::pair<BodyIndex, BodyIndex>, double> out;
    for (const Contact& c : pipeline.find(view, view.velocity, view.angular_velocity, kDt)) out[{c.a, c.b}] = c.gap;
    EXPECT_EQ(out.size(), pipeline.counts().contacts) << "each pair once";
    return out;
  }
};

/// The least gap of two spheres that keep their velocities for a step [m].
double least_gap(const Vec3& way, const Vec3& velocity, double radii) {
  const double speed2 = squared_norm(velocity);
  const double nearest = speed2 > 0.0 ? std::clamp(-dot(way, velocity) / speed2, 0.0, kDt) : 0.0;
  return norm(way + nearest * velocity) - radii;
}

// Law: two spheres that meet within the step are a pair, unless nothing moves them; what is further apart than they can move
// and the slack is none. A pair that is apart gets relative speed times step and the slack as reach; one that touches at
// least the slack. The same pairs come out with and without boxes, however many there are.
TEST(SpherePairs, are_those_that_can_meet) {
  RandomNumbers random{77};
  std::size_t touching = 0, apart = 0, still = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const bool on_plane = trial % 5 == 0, all_movable = trial % 2 == 0;
    const Gas gas{random, trial < 60 ? 1 + random.below(12) : 150, all_movable, on_plane};
    const auto found = gas.pairs(true, 1);
    const auto with_boxes = gas.pairs(false, 2);
    ASSERT_EQ(found.size(), with_boxes.size());
    EXPECT_EQ(found, gas.pairs(true, 2));
    const BodyView view = gas.bodies.view();
    for (BodyIndex b = 0; b < view.size(); ++b) {
      for (BodyIndex a = on_plane ? 1 : 0; a < b; ++a) {
        const Vec3 way = view.position[b] - view.position[a], velocity = view.velocity[b] - view.velocity[a];
        const double radii = gas.radius[a] + gas.radius[b], gap = norm(way) - radii;
        const double most = kDt * norm(velocity) + kSlack * std::min(gas.radius[a], gas.radius[b]);
        const auto pair = found.find({a, b});
        const bool is_pair = pair != found.end();
        EXPECT_EQ(is_pair, with_boxes.contains({a, b}));
        if (view.motion[a] != Motion::dynamic && view.motion[b] != Motion::dynamic) {
          EXPECT_FALSE(is_pair);
          ++still;
          continue;
        }
        // Rounding: lengths of one, a hundred operations.
        EXPECT_TRUE(is_pair || least_gap(way, velocity, radii) >= -1e-13);
        EXPECT_TRUE(!is_pair || gap <= most + 1e-13);
        if (!is_pair) continue;
        EXPECT_TRUE(gap <= 1e-8 || std::abs(pair->second - most) <= 1e-15);
        EXPECT_GE(pair->second, kSlack * std::min(gas.radius[a], gas.radius[b]) * (1.0 - 1e-12));
        ++(gap > 0.0 ? apart : touching);
      }
    }
  }
  EXPECT_GT(touching, 2000u);
  EXPECT_GT(apart, 500u);
  EXPECT_GT(still, 2000u);
}

// Law: a sphere above a plane is a pair with it while its fall can close the gap, the plane's infinite ball notwithstanding.
TEST(SpherePairs, planes_keep_the_reach_of_motion) {
  RandomNumbers random{78};
  Gas gas{random, 0, true, true};
  constexpr double kRadius = 0.1, kSpeed = 2.0;
  for (int i = 0; i < 9; ++i) {
    gas.add(shape_data(sphere_data(kRadius)), {double(i), 0, -0.4 + kRadius + 0.0391 + 2.5e-4 * i}, {0, 0, -kSpeed},
            Motion::dynamic);
  }
  const auto found = gas.pairs(true, 1);
  // Reach 0.04 + 0.001; the last gap is 0.0411.
  ASSERT_EQ(found.size(), 8u);
  for (const auto& [pair, reach] : found) EXPECT_NEAR(reach, kDt * kSpeed + kSlack * kRadius, 1e-15);
}

}  // namespace
}  // namespace scree
