#include "scree/collision/collision_filter.hpp"

#include <gtest/gtest.h>

#include <set>

#include "scree/base/error.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"
#include "support/pair_scene.hpp"

namespace scree {
namespace {

using namespace test;
using BodyPair = std::pair<BodyId, BodyId>;

/// Reports all pairs.
class Everything : public BroadPhase {
 public:
  void find_pairs(const BoxView& boxes, const Executor&, std::vector<CandidatePair>& out) override {
    for (ColliderIndex j = 1; j < boxes.size(); ++j) {
      for (ColliderIndex i = 0; i < j; ++i) out.push_back({i, j});
    }
  }
};

/// One contact a pair of the kinds that it knows.
class OneContact : public NarrowPhase {
 public:
  explicit OneContact(std::set<ShapeKind> kinds) : kinds_{std::move(kinds)} {}
  [[nodiscard]] bool supports(ShapeKind a, ShapeKind b) const override {
    return kinds_.contains(a) && kinds_.contains(b);
  }
  void collide(const ColliderView& c, std::span<const ColliderPair> pairs, ContactBuffer& out) const override {
    for (const ColliderPair& p : pairs) out.push_back({c.body[p.a], c.body[p.b], 0, 0, 0, {}, {0, 0, 1}, 0.0});
  }

 private:
  std::set<ShapeKind> kinds_;
};

/// Balls that all overlap.
struct Heap {
  ShapeSet shapes;
  BodyStore bodies;
  Everything broad;
  OneContact narrow{{ShapeKind::sphere, ShapeKind::plane}};
  Executor executor{1};
  CollisionPipeline pipeline{shapes, broad, {&narrow}, executor};

  void add(CollisionGroup group, Motion motion = Motion::dynamic, const PrimitiveData& primitive = sphere_data(1.0)) {
    NewBody body;
    body.motion = motion;
    body.shape = shapes.add(shape_data(primitive));
    body.collision_group = group;
    bodies.add(body);
  }
  std::set<BodyPair> find() {
    const BodyView view = bodies.view();
    std::set<BodyPair> pairs;
    for (const Contact& c : pipeline.find(view, view.velocity, view.angular_velocity, 0.0)) {
      pairs.insert({view.id[c.a], view.id[c.b]});
    }
    return pairs;
  }
};

// Law: a pair of groups that does not meet takes exactly the pairs of its bodies away, within a group too.
TEST(CollisionFilter, groups_meet_as_told) {
  Heap heap;
  for (const int group : {0, 1, 1, 31}) heap.add(static_cast<CollisionGroup>(group));
  EXPECT_FALSE(heap.pipeline.filter().is_active());
  EXPECT_EQ(heap.find().size(), 6u);
  heap.pipeline.filter().set_groups_meet(1, 1, false);
  heap.pipeline.filter().set_groups_meet(31, 0, false);
  EXPECT_TRUE(heap.pipeline.filter().is_active());
  EXPECT_EQ(heap.find(), (std::set<BodyPair>{{0, 1}, {0, 2}, {1, 3}, {2, 3}}));
  heap.pipeline.filter().set_groups_meet(1, 1, true);
  heap.pipeline.filter().set_groups_meet(0, 31, true);
  EXPECT_FALSE(heap.pipeline.filter().is_active());
  EXPECT_EQ(heap.find().size(), 6u);
}

// Law: an excluded pair makes no contact until it was admitted as often as it was excluded; other pairs of its bodies do.
TEST(CollisionFilter, excluded_pairs_are_counted) {
  Heap heap;
  for (int i = 0; i < 4; ++i) heap.add(0);
  CollisionFilter& filter = heap.pipeline.filter();
  filter.exclude(3, 1);
  filter.exclude(1, 3);
  filter.exclude(2, 3);
  EXPECT_EQ(filter.excluded_pairs(), 2u);
  const std::set<BodyPair> kept{{0, 1}, {0, 2}, {0, 3}, {1, 2}};
  EXPECT_EQ(heap.find(), kept);
  filter.admit(1, 3);
  EXPECT_EQ(heap.find(), kept);
  filter.admit(3, 1);
  filter.admit(3, 2);
  EXPECT_FALSE(filter.is_active());
  EXPECT_EQ(heap.find().size(), 6u);
  EXPECT_THROW(filter.admit(1, 3), std::logic_error);
}

// Law: whoever keeps pairs can tell that they are out of date.
TEST(CollisionFilter, every_change_is_another_version) {
  CollisionFilter filter;
  std::set<std::uint64_t> versions{filter.version()};
  filter.exclude(3, 1);
  EXPECT_TRUE(versions.insert(filter.version()).second);
  filter.admit(1, 3);
  EXPECT_TRUE(versions.insert(filter.version()).second);
  filter.set_groups_meet(1, 2, false);
  EXPECT_TRUE(versions.insert(filter.version()).second);
}

// Law: pairs go by id: bodies that leave take their pairs along, and the others keep theirs at new indices.
TEST(CollisionFilter, exclusions_follow_ids_when_bodies_leave) {
  Heap heap;
  for (int i = 0; i < 5; ++i) heap.add(0);
  heap.pipeline.filter().exclude(0, 4);
  heap.pipeline.filter().exclude(3, 4);
  heap.pipeline.filter().exclude(1, 90);
  heap.bodies.remove(std::vector<char>{1, 0, 1, 0, 0});
  EXPECT_EQ(heap.find(), (std::set<BodyPair>{{1, 3}, {1, 4}}));
}

// Law: planes, which no broad phase sees, are filtered as all others.
TEST(CollisionFilter, planes_are_filtered) {
  Heap heap;
  heap.add(0, Motion::fixed, plane_data());
  heap.add(1);
  heap.add(0);
  heap.pipeline.filter().exclude(0, 2);
  EXPECT_EQ(heap.find(), (std::set<BodyPair>{{0, 1}, {1, 2}}));
  heap.pipeline.filter().set_groups_meet(0, 1, false);
  EXPECT_TRUE(heap.find().empty());
}

// Law: kinds in groups that do not meet need no narrow phase.
TEST(CollisionFilter, support_is_asked_for_groups_that_meet) {
  Heap heap;
  heap.add(0);
  heap.add(2, Motion::dynamic, primitive_data(ShapeKind::box, {1, 1, 1}));
  EXPECT_THROW(heap.pipeline.check_support(heap.bodies.view()), Error);
  heap.pipeline.filter().set_groups_meet(0, 2, false);
  EXPECT_NO_THROW(heap.pipeline.check_support(heap.bodies.view()));
}

}  // namespace
}  // namespace scree
