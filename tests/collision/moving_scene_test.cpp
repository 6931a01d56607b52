// All broad phases beside each other through a moving scene, with the memory that each keeps between steps.
//
// SCREE_MOVING_SCENE="BODIES FRAMES" makes it larger than the test of every day.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "collision_parts.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree {
namespace {

using namespace test;

struct Extent {
  std::size_t bodies = 1500;
  int frames = 25;
};

Extent extent() {
  Extent out;
  if (const char* text = std::getenv("SCREE_MOVING_SCENE")) std::istringstream{text} >> out.bodies >> out.frames;
  return out;
}

/// A cloud of balls and shavings, 1 to 8 mm, that moves through a floor's plane and a turning box; a few of them are
/// exchanged in each frame.
class MovingCloud {
 public:
  explicit MovingCloud(std::size_t count) : edge_{0.006 * std::cbrt(static_cast<double>(count))} {
    add(shape_data(plane_data()), {{0, 0, -edge_}, {}}, Motion::fixed);
    add(shape_data(primitive_data(ShapeKind::box, {0.2 * edge_, 0.3 * edge_, 0.1 * edge_})), {}, Motion::kinematic);
    while (bodies.size() < count) add_grain();
  }

  void next_frame(double dt) {
    BodyState state = bodies.state();
    for (std::size_t i = 2; i < bodies.size(); ++i) {
      state.position[i] += dt * state.velocity[i];
      // What leaves on one side comes back on the other: a long way for a structure that follows it.
      for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        double& x = state.position[i].*axis;
        if (std::abs(x) > edge_) x -= std::copysign(2.0 * edge_, x);
      }
    }
    const std::size_t count = bodies.size();
    std::vector<char> gone(count, 0);
    for (std::size_t k = 0; k < 5 + count / 1000; ++k) gone[2 + random_.below(count - 2)] = 1;
    bodies.remove(gone);
    while (bodies.size() < count) add_grain();
  }

  ShapeSet shapes;
  BodyStore bodies;

 private:
  void add(const ShapeData& shape, const Pose& pose, Motion motion) {
    NewBody body;
    body.motion = motion;
    body.shape = shapes.add(shape);
    body.pose = pose;
    if (motion == Motion::dynamic) body.velocity = random_.in_cube(1.5);
    if (motion == Motion::kinematic) body.angular_velocity = {0, 3, 1};
    bodies.add(body);
  }
  void add_grain() {
    const double size = random_.uniform(1e-3, 8e-3);
    if (random_.below(3) == 0) {
      std::vector<Sphere> parts;
      for (int k = 0; k < 4; ++k) parts.push_back({random_.in_cube(0.5 * size), 0.3 * size});
      add(shape_data(cluster_data(parts)), random_.pose(edge_), Motion::dynamic);
    } else {
      add(shape_data(sphere_data(0.5 * size)), random_.pose(edge_), Motion::dynamic);
    }
  }

  double edge_;
  RandomNumbers random_{71};
};

/// Frames between two in which everything is compared with everything: that takes as long as all the rest for 20 000 bodies.
constexpr int kFramesOfBruteForce = 10;

// Law: whatever a broad phase keeps between steps, it gives the same contacts as the others, frame by frame, while bodies
// move, come and go; in every tenth frame these are shown to be what comparing everything gives. What a phase lost in
// between and never got back would show there, and what it lost for a few frames beside the three others.
TEST(MovingScene, every_broad_phase_gives_the_same_contacts) {
  const auto [count, frames] = extent();
  MovingCloud cloud{count};
  const Executor executor{2};
  const auto narrow = make_plugin<NarrowPhase>("sphere_cluster");
  std::vector<std::string> names{"grid", "bullet_dbvt", "bullet_sap", "fcl_tree", "brute_force"};
  std::vector<std::unique_ptr<BroadPhase>> phases;
  std::vector<std::unique_ptr<CollisionPipeline>> pipelines;
  for (const std::string& name : names) {
    phases.push_back(make_plugin<BroadPhase>(name));
    pipelines.push_back(std::make_unique<CollisionPipeline>(cloud.shapes, *phases.back(),
                                                            std::vector<NarrowPhase*>{narrow.get()}, executor));
  }
  std::size_t found = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const BodyView view = cloud.bodies.view();
    std::vector<Contact> expected;
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] == "brute_force" && frame % kFramesOfBruteForce != 0) continue;
      const auto contacts = pipelines[k]->find(view, view.velocity, view.angular_velocity, 1e-3);
      if (k == 0) expected.assign(contacts.begin(), contacts.end());
      ASSERT_TRUE(same_bits(contacts, expected)) << names[k] << ", frame " << frame;
    }
    found += expected.size();
    cloud.next_frame(1e-3);
  }
  EXPECT_GT(found, count * static_cast<std::size_t>(frames) / 10) << "a cloud without contacts shows nothing";
}

}  // namespace
}  // namespace scree
