#include "scree/collision/collision_pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scree/base/error.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree {
namespace {

using namespace test;

/// Reports all pairs, some twice and the wrong way round, in an order that changes with every call.
class AllPairs : public BroadPhase {
 public:
  void find_pairs(const BoxView& boxes, const Executor&, std::vector<CandidatePair>& out) override {
    const auto n = static_cast<ColliderIndex>(boxes.size());
    for (ColliderIndex i = 0; i < n; ++i) {
      EXPECT_TRUE(is_bounded(boxes.box[i]));
      for (ColliderIndex j = 0; j < i; ++j) {
        out.push_back({i, j});
        if ((i + j + calls_) % 3 == 0) out.push_back({j, i});
      }
    }
    std::rotate(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(out.size() / 3), out.end());
    if (calls_++ % 2 == 1) std::reverse(out.begin(), out.end());
  }

 private:
  unsigned calls_ = 0;
};

/// All pairs of balls, without boxes.
class AllPairsOfBalls : public BroadPhase {
 public:
  [[nodiscard]] bool takes_balls_alone() const override { return true; }
  void find_pairs(const BoxView& boxes, const Executor&, std::vector<CandidatePair>& out) override {
    const auto n = static_cast<ColliderIndex>(boxes.size());
    const auto is_plane = [&](ColliderIndex i) { return std::isinf(boxes.ball[i].radius); };
    for (ColliderIndex i = 0; i < n; ++i) {
      for (ColliderIndex j = 0; j < i; ++j) {
        if (!is_plane(i) && !is_plane(j)) out.push_back({i, j});
      }
    }
  }
};

/// Two contacts a pair, with the pair's reach as gap, so that tests see what the pipeline asked for.
class EchoPhase : public NarrowPhase {
 public:
  explicit EchoPhase(std::set<ShapeKind> kinds) : kinds_{std::move(kinds)} {}
  [[nodiscard]] bool supports(ShapeKind a, ShapeKind b) const override {
    return kinds_.contains(a) && kinds_.contains(b);
  }
  void bind(const ShapeSet& shapes, std::size_t first) override {
    EXPECT_EQ(first, bound);
    bound = shapes.primitives().size();
  }
  void collide(const ColliderView& c, std::span<const ColliderPair> pairs, ContactBuffer& out) const override {
    for (const ColliderPair& p : pairs) {
      EXPECT_LT(std::max(c.primitive[p.a], c.primitive[p.b]), bound);
      for (std::uint64_t feature = 0; feature < 2; ++feature) {
        out.push_back({c.body[p.a], c.body[p.b], c.ordinal[p.a], c.ordinal[p.b], feature, {}, {0, 0, 1}, p.reach});
      }
    }
  }
  std::size_t bound = 0;

 private:
  std::set<ShapeKind> kinds_;
};

const std::set<ShapeKind> kAllKinds{ShapeKind::sphere, ShapeKind::box, ShapeKind::plane, ShapeKind::cylinder};

/// Bodies, shapes and a pipeline with the two fakes above.
struct Scene {
  ShapeSet shapes;
  BodyStore bodies;
  AllPairs broad;
  EchoPhase narrow{kAllKinds};
  Executor executor{1};
  CollisionPipeline pipeline{shapes, broad, {&narrow}, executor, {0.0}};

  std::size_t add(const ShapeData& shape, const Vec3& at, const Vec3& velocity = {}, const Vec3& spin = {},
                  Motion motion = Motion::dynamic) {
    NewBody body;
    body.motion = motion;
    body.shape = shapes.add(shape);
    body.pose.position = at;
    body.velocity = velocity;
    body.angular_velocity = spin;
    bodies.add(body);
    return bodies.size() - 1;
  }
  std::span<const Contact> find(double dt) {
    const BodyView view = bodies.view();
    return pipeline.find(view, view.velocity, view.angular_velocity, dt);
  }
};

ShapeData ball(double r) { return shape_data(sphere_data(r)); }

TEST(CollisionPipeline, resting_bodies_get_the_slack_only) {
  Scene scene;
  scene.add(ball(1.0), {0, 0, 0});
  scene.add(ball(3.0), {0, 0, 3.9});
  CollisionPipeline pipeline{scene.shapes, scene.broad, {&scene.narrow}, scene.executor, {1e-3}};
  const BodyView view = scene.bodies.view();
  const auto contacts = pipeline.find(view, view.velocity, view.angular_velocity, 1.0);
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_DOUBLE_EQ(contacts[0].gap, 1e-3) << "of the smaller radius";
}

// Law: the reach is the relative motion within the step; bodies that move alike pay nothing.
TEST(CollisionPipeline, reach_is_relative_motion) {
  Scene scene;
  scene.add(ball(1.0), {0, 0, 0}, {5, 0, 0});
  scene.add(ball(1.0), {1.9, 0, 0}, {5, 0, 0});
  scene.add(ball(1.0), {0, 1.9, 0}, {2, 4, 0});
  const auto contacts = scene.find(0.01);
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_EQ(contacts[0].gap, 0.0);
  EXPECT_DOUBLE_EQ(contacts[2].gap, 0.05) << "|(3, -4)| m/s for 0.01 s";
}

// Law: grains at rest have the pairs whose gap is below the slack, whether or not a fast one flies through them and plates
// stand by; the fast one adds no more than what lies in the box that it sweeps.
TEST(CollisionPipeline, slow_grains_pay_nothing_for_a_fast_one) {
  Scene scene;
  CollisionPipeline pipeline{scene.shapes, scene.broad, {&scene.narrow}, scene.executor};
  const auto pairs = [&] {
    const BodyView view = scene.bodies.view();
    static_cast<void>(pipeline.find(view, view.velocity, view.angular_velocity, 1e-3));
    return pipeline.counts().pairs;
  };
  constexpr double kRadius = 1e-3, kSpeed = 10.0;
  std::vector<Vec3> places;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z) places.push_back(2.0005e-3 * Vec3{double(x), double(y), double(z)});
    }
  }
  for (const Vec3& at : places) scene.add(ball(kRadius), at);
  // The next grain is 5e-7 m away, half of the slack.
  const std::size_t rest = pairs();
  EXPECT_EQ(rest, 3u * 7u * 8u * 8u);
  scene.add(shape_data(primitive_data(ShapeKind::box, {0.1, 0.1, 5e-4})), {0, 0, -4e-3}, {}, {}, Motion::fixed);
  EXPECT_EQ(pairs(), rest) << "a plate 2.5 mm below grains at rest costs nothing";
  const Vec3 from{-6e-3, 7e-3, 7e-3};
  scene.add(ball(kRadius), from, {kSpeed, 0, 0});
  const Aabb swept{from - 1.01 * Vec3{kRadius, kRadius, kRadius},
                   from + 1.01 * Vec3{kRadius, kRadius, kRadius} + Vec3{1e-3 * kSpeed, 0, 0}};
  const auto in_the_way = std::count_if(places.begin(), places.end(), [&](const Vec3& at) {
    return overlap(swept, expanded(Aabb{at, at}, 1.01 * kRadius));
  });
  const std::size_t with_fast = pairs();
  EXPECT_GT(with_fast, rest);
  EXPECT_LE(with_fast, rest + static_cast<std::size_t>(in_the_way));
}

// Law: a grain that a turning drum carries moves with it: no reach; a grain at rest beside it gets what the drum's surface
// does at its place.
TEST(CollisionPipeline, turning_bodies_carry_their_neighbours) {
  Scene scene;
  scene.add(shape_data(primitive_data(ShapeKind::cylinder, {1, 1, 0})), {0, 0, 0}, {}, {0, 0, 10}, Motion::kinematic);
  scene.add(ball(0.1), {1.05, 0, 0}, {0, 10.5, 0});
  scene.add(ball(0.1), {0, 1.05, 0});
  const auto contacts = scene.find(0.01);
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_NEAR(contacts[0].gap, 0.0, 1e-15);
  EXPECT_NEAR(contacts[2].gap, 0.105, 1e-15);
}

// Law: a sphere's own spin brings it no nearer; a box's does, by its bounding radius.
TEST(CollisionPipeline, spin_counts_for_what_is_not_round) {
  Scene scene;
  scene.add(ball(1.0), {0, 0, 0}, {}, {7, 0, 0});
  scene.add(ball(2.0), {0, 0, 2.9}, {}, {-7, 0, 0});
  scene.add(shape_data(primitive_data(ShapeKind::box, {0.2, 0.2, 0.1})), {1.1, 0, 0}, {}, {0, 0, 3});
  const auto contacts = scene.find(0.1);
  ASSERT_EQ(contacts.size(), 4u);
  EXPECT_EQ(contacts[0].gap, 0.0);
  EXPECT_NEAR(contacts[2].gap, 0.1 * 3.0 * 0.3, 1e-15) << "spin times the bounding radius of 0.3 m";
}

TEST(CollisionPipeline, immovable_pairs_same_body_and_non_colliding_are_left_out) {
  Scene scene;
  ShapeData dumbbell;
  dumbbell.primitives = {sphere_data(1.0), sphere_data(1.0), sphere_data(1.0)};
  dumbbell.primitives[1].primitive.collides = false;
  dumbbell.primitives[2].primitive.local.position = {0.5, 0, 0};
  scene.add(ball(1.0), {0, 0, 0}, {}, {}, Motion::fixed);
  scene.add(ball(1.0), {0.1, 0, 0}, {}, {}, Motion::kinematic);
  scene.add(dumbbell, {0.2, 0, 0});
  const auto contacts = scene.find(0.0);
  ASSERT_EQ(contacts.size(), 8u) << "two bodies x two primitives x two features";
  std::vector<std::array<std::uint64_t, 5>> order;
  for (const Contact& c : contacts) order.push_back({c.a, c.b, c.primitive_a, c.primitive_b, c.feature});
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  EXPECT_EQ(order.back(), (std::array<std::uint64_t, 5>{1, 2, 0, 2, 1})) << "ordinals count all primitives of a shape";
}

// Law: a plane meets what its surface can reach, on either side of the order of bodies, and no other plane.
TEST(CollisionPipeline, planes_are_paired_with_what_comes_near) {
  Scene scene;
  scene.add(ball(1.0), {0, 0, 0.9});
  scene.add(shape_data(plane_data()), {0, 0, 0}, {}, {}, Motion::fixed);
  scene.add(shape_data(plane_data()), {0, 0, 0}, {}, {}, Motion::fixed);
  scene.add(ball(1.0), {1e6, 0, 1.5});
  scene.add(ball(1.0), {1e6, 9, 1.5}, {0, 0, -6});
  const auto contacts = scene.find(0.1);
  std::set<std::pair<BodyIndex, BodyIndex>> pairs;
  for (const Contact& c : contacts) pairs.insert({c.a, c.b});
  EXPECT_EQ(pairs, (std::set<std::pair<BodyIndex, BodyIndex>>{{0, 1}, {0, 2}, {1, 4}, {2, 4}}));
}

// Law: neither the order and the doubles of the broad phase nor the number of threads show in the result.
TEST(CollisionPipeline, result_depends_on_the_bodies_only) {
  Scene scene;
  RandomNumbers random{6};
  for (int i = 0; i < 300; ++i) {
    scene.add(ball(random.decades(0.01, 0.3)), random.in_cube(0.7), random.in_cube(1.0), random.in_cube(1.0));
  }
  const auto first = scene.find(0.01);
  const std::vector<Contact> expected(first.begin(), first.end());
  EXPECT_GT(expected.size(), 500u);
  const Executor two{2};
  const BodyView view = scene.bodies.view();
  for (int repeat = 0; repeat < 3; ++repeat) {
    CollisionPipeline pipeline{scene.shapes, scene.broad, {&scene.narrow}, two, {0.0}};
    scene.narrow.bound = 0;
    const auto again = pipeline.find(view, view.velocity, view.angular_velocity, 0.01);
    ASSERT_EQ(again.size(), expected.size());
    for (std::size_t k = 0; k < again.size(); ++k) {
      EXPECT_EQ(again[k].a, expected[k].a);
      EXPECT_EQ(again[k].b, expected[k].b);
      EXPECT_EQ(again[k].gap, expected[k].gap);
    }
    EXPECT_EQ(pipeline.counts().contacts, expected.size());
    EXPECT_EQ(pipeline.counts().pairs * 2, expected.size());
  }
}

// Law: of bodies that are expected to stay, neighbours are what lies within the skin, whether or not boxes are looked at.
TEST(CollisionPipeline, neighbours_are_within_the_skin) {
  for (const Motion motion : {Motion::fixed, Motion::kinematic}) {
    Scene scene;
    AllPairsOfBalls balls_alone;
    scene.add(shape_data(plane_data()), {0, 0, -1.09}, {}, {}, motion);
    scene.add(ball(1.0), {0, 0, 0}, {9, 9, 9});
    scene.add(ball(1.0), {2.09, 0, 0});
    scene.add(ball(1.0), {0, 2.11, 0});
    scene.add(ball(1.0), {-1.99, 0, 0.02});
    for (BroadPhase* broad : std::initializer_list<BroadPhase*>{&scene.broad, &balls_alone}) {
      EchoPhase narrow{kAllKinds};
      CollisionPipeline pipeline{scene.shapes, *broad, {&narrow}, scene.executor};
      const std::vector<Vec3> still(scene.bodies.size());
      const NeighbourView found = pipeline.find_neighbours(scene.bodies.view(), {still, 0.0, 0.1});
      std::vector<BodyPair> expected{{1, 2}, {1, 4}};
      // The plane and three balls; one is 2 cm too high.
      if (motion == Motion::fixed) expected = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}};
      EXPECT_TRUE(std::ranges::equal(found.balls, expected));
      EXPECT_EQ(found.others.size(), motion == Motion::fixed ? 0u : 4u) << "a plane at rest is simple";
    }
  }
}

// Law: who is no neighbour does not come within the skin on the way that is expected, at whatever time. Most who do not come
// near on that way are no neighbours.
TEST(CollisionPipeline, neighbours_are_those_who_can_meet_on_the_way_that_is_expected) {
  constexpr double kHorizon = 0.5, kSkin = 0.1;
  Scene scene;
  RandomNumbers random{7};
  std::vector<Vec3> velocity;
  std::vector<double> radius;
  for (int k = 0; k < 200; ++k) {
    radius.push_back(random.uniform(0.3, 1.0));
    scene.add(ball(radius.back()), random.in_cube(6.0));
    velocity.push_back(random.in_cube(4.0));
  }
  scene.add(shape_data(plane_data()), {0, 0, -6}, {}, {}, Motion::fixed);
  velocity.push_back({});
  radius.push_back(0.0);
  EchoPhase narrow{kAllKinds};
  CollisionPipeline pipeline{scene.shapes, scene.broad, {&narrow}, scene.executor};
  const BodyView bodies = scene.bodies.view();
  const NeighbourView found = pipeline.find_neighbours(bodies, {velocity, kHorizon, kSkin});
  const std::set<std::pair<BodyIndex, BodyIndex>> listed = [&] {
    std::set<std::pair<BodyIndex, BodyIndex>> pairs;
    for (const BodyPair& pair : found.balls) pairs.insert({pair.a, pair.b});
    return pairs;
  }();
  EXPECT_EQ(listed.size(), found.balls.size());
  std::size_t meeting = 0;
  for (BodyIndex a = 0; a < bodies.size(); ++a) {
    for (BodyIndex b = a + 1; b < bodies.size(); ++b) {
      double least = std::numeric_limits<double>::infinity();
      for (int s = 0; s <= 50; ++s) {
        const double t = kHorizon * s / 50.0;
        const Vec3 apart = bodies.position[b] - bodies.position[a] + t * (velocity[b] - velocity[a]);
        const bool plane = b + 1 == bodies.size();
        least = std::min(least, (plane ? -apart.z : norm(apart)) - radius[a] - radius[b]);
      }
      meeting += least < kSkin ? 1 : 0;
      if (least < kSkin) {
        EXPECT_TRUE(listed.contains({a, b})) << a << " and " << b << " come within " << least;
      }
    }
  }
  EXPECT_GT(meeting, 100u);
  EXPECT_LT(listed.size(), bodies.size() * bodies.size() / 20) << "a tenth of all pairs";
}

// Law: bodies added and removed between steps are seen at once, and new shapes are bound before they are used.
TEST(CollisionPipeline, follows_bodies_that_come_and_go) {
  Scene scene;
  scene.add(ball(1.0), {0, 0, 0});
  EXPECT_TRUE(scene.find(0.0).empty());
  scene.add(ball(1.0), {1, 0, 0});
  EXPECT_EQ(scene.find(0.0).size(), 2u);
  scene.bodies.remove(std::vector<char>{1, 0});
  EXPECT_TRUE(scene.find(0.0).empty());
}

// Law: a body whose position is not a number meets nothing, and the others meet as without it.
TEST(CollisionPipeline, a_diverged_body_meets_nothing) {
  Scene scene;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  scene.add(shape_data(plane_data()), {0, 0, 0}, {}, {}, Motion::fixed);
  scene.add(ball(1.0), {nan, 0, nan});
  scene.add(shape_data(primitive_data(ShapeKind::box, {1, 1, 1})), {0, 0, 0.5}, {nan, 0, 0}, {0, nan, 0});
  scene.add(ball(1.0), {0, 0, 0.5});
  const auto contacts = scene.find(0.1);
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].a, 0u);
  EXPECT_EQ(contacts[0].b, 3u);
}

TEST(CollisionPipeline, names_the_kinds_that_no_phase_supports) {
  Scene scene;
  EchoPhase spheres{{ShapeKind::sphere}};
  CollisionPipeline pipeline{scene.shapes, scene.broad, {&spheres}, scene.executor};
  scene.add(ball(1.0), {0, 0, 0});
  scene.add(ball(1.0), {5, 0, 0}, {}, {}, Motion::fixed);
  EXPECT_NO_THROW(pipeline.check_support(scene.bodies.view()));
  scene.add(shape_data(primitive_data(ShapeKind::box, {1, 1, 1})), {9, 0, 0}, {}, {}, Motion::fixed);
  try {
    pipeline.check_support(scene.bodies.view());
    FAIL() << "sphere against box is not supported";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("sphere against box"), std::string::npos) << text;
  }
}

// Law: the first phase of the chain that supports a pair gets it.
TEST(CollisionPipeline, chain_goes_to_the_first_that_supports_the_pair) {
  Scene scene;
  EchoPhase spheres{{ShapeKind::sphere}};
  CollisionPipeline pipeline{scene.shapes, scene.broad, {&spheres, &scene.narrow}, scene.executor};
  scene.add(ball(1.0), {0, 0, 0});
  scene.add(shape_data(primitive_data(ShapeKind::box, {1, 1, 1})), {1, 0, 0});
  scene.add(ball(1.0), {1, 1, 0});
  const BodyView view = scene.bodies.view();
  EXPECT_EQ(pipeline.find(view, view.velocity, view.angular_velocity, 0.0).size(), 6u);
}

}  // namespace
}  // namespace scree
