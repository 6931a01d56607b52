// Contacts of a few bodies with walls, beside all contacts of a scene.
#include <gtest/gtest.h>

#include <algorithm>

#include "collision_parts.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree {
namespace {

using namespace test;

// Law: what a search for the walls of a few bodies finds is what a search for all contacts finds of them, bit by bit, and in its
// order; the contacts found before stay as they are.
TEST(WallSearch, finds_what_a_search_for_all_finds) {
  RandomNumbers random{4};
  ShapeSet shapes;
  BodyStore bodies;
  const auto add = [&](const ShapeData& shape, const Pose& pose, Motion motion) {
    NewBody body;
    body.motion = motion;
    body.shape = shapes.add(shape);
    body.pose = pose;
    if (motion == Motion::dynamic) body.velocity = random.in_cube(3.0);
    bodies.add(body);
  };
  for (int k = 0; k < 400; ++k) {
    if (k == 50) add(shape_data(plane_data()), {{0, 0, -0.02}, {}}, Motion::fixed);
    if (k % 100 == 20) {
      add(shape_data(primitive_data(ShapeKind::box, {0.01, 0.02, 5e-4})), random.pose(0.02), Motion::kinematic);
    }
    const auto grain = k % 3 == 0 ? cluster_data({{{1e-3, 0, 0}, 1e-3}, {{-1e-3, 0, 0}, 1e-3}}) : sphere_data(1e-3);
    add(shape_data(grain), random.pose(0.03), Motion::dynamic);
  }
  const auto broad = make_plugin<BroadPhase>("grid");
  const auto narrow = make_plugin<NarrowPhase>("sphere_cluster");
  const Executor executor{2};
  CollisionPipeline pipeline{shapes, *broad, {narrow.get()}, executor};
  const BodyView view = bodies.view();
  const auto all = pipeline.find(view, view.velocity, view.angular_velocity, 1e-3);
  const std::vector<Contact> before{all.begin(), all.end()};
  std::vector<BodyIndex> few;
  for (BodyIndex i = 0; i < view.size(); ++i) {
    if (view.motion[i] == Motion::dynamic && i % 2 == 0) few.push_back(i);
  }
  const auto is_few = [&](BodyIndex i) { return std::ranges::binary_search(few, i); };
  std::vector<Contact> expected;
  for (const Contact& c : before) {
    const bool of_wall = view.motion[c.a] != Motion::dynamic || view.motion[c.b] != Motion::dynamic;
    if (of_wall && (is_few(c.a) || is_few(c.b))) expected.push_back(c);
  }
  const auto found = pipeline.find_walls(view, few, view.velocity, view.angular_velocity, 1e-3);
  EXPECT_TRUE(same_bits(found, expected)) << found.size() << " contacts, " << expected.size() << " expected";
  EXPECT_GT(expected.size(), 20u) << "few contacts show nothing";
  EXPECT_TRUE(same_bits(all, before));
}

}  // namespace
}  // namespace scree
