// Every broad phase, the closed forms and the pipeline together, loaded as a scene loads them.
#include <gtest/gtest.h>

#include <limits>

#include "collision_parts.hpp"
#include "scree/collision/collision_pipeline.hpp"
#include "scree/model/body_store.hpp"
#include "scree/parallel/executor.hpp"
#include "support/pair_scene.hpp"
#include "support/random_numbers.hpp"

namespace scree {
namespace {

using namespace test;

/// Grains and shavings of 0.5 mm to 5 cm in a drum of 1 m on legs, above a floor, all of them moving.
struct Scene {
  ShapeSet shapes;
  BodyStore bodies;
  RandomNumbers random{23};

  void add(const ShapeData& shape, const Pose& pose, Motion motion = Motion::dynamic) {
    NewBody body;
    body.motion = motion;
    body.shape = shapes.add(shape);
    body.pose = pose;
    if (motion != Motion::fixed) {
      body.velocity = random.in_cube(2.0);
      body.angular_velocity = random.in_cube(20.0);
    }
    bodies.add(body);
  }
  struct Empty {};
  explicit Scene(Empty) {}
  Scene() {
    add(shape_data(primitive_data(ShapeKind::cylinder, {0.5, 0.5, 0}, true)), {}, Motion::kinematic);
    add(shape_data(plane_data()), {{0, 0, -0.3}, {}}, Motion::fixed);
    ShapeData legs;
    for (const double x : {-0.2, 0.2}) {
      legs.primitives.push_back(primitive_data(ShapeKind::box, {0.03, 0.03, 0.3}));
      legs.primitives.back().primitive.local.position = {x, 0, 0};
    }
    add(legs, {}, Motion::fixed);
    for (int i = 0; i < 1500; ++i) {
      const double size = random.decades(5e-4, 5e-2);
      const Pose pose = random.pose(0.33);
      if (i % 3 == 0) {
        add(shape_data(sphere_data(size)), pose);
      } else {
        std::vector<Sphere> parts;
        for (int k = 0; k < 5; ++k) parts.push_back({random.in_cube(size), 0.4 * size});
        add(shape_data(cluster_data(parts)), pose);
      }
    }
  }
};

std::vector<Contact> contacts_of(const Scene& scene, const std::string& broad_name, int threads) {
  const Executor executor{threads};
  const auto broad = make_plugin<BroadPhase>(broad_name);
  const auto narrow = make_plugin<NarrowPhase>("sphere_cluster");
  CollisionPipeline pipeline{scene.shapes, *broad, {narrow.get()}, executor};
  const BodyView view = scene.bodies.view();
  pipeline.check_support(view);
  pipeline.find(view, view.velocity, view.angular_velocity, 1e-3);
  const auto found = pipeline.find(view, view.velocity, view.angular_velocity, 1e-3);
  return {found.begin(), found.end()};
}

// Law: contacts depend on the bodies alone, bit by bit: not on the broad phase, nor on threads, nor on the run.
TEST(CollisionPhases, contacts_do_not_depend_on_phase_or_threads) {
  const Scene scene;
  const std::vector<Contact> expected = contacts_of(scene, "grid", 1);
  EXPECT_GT(expected.size(), 2000u);
  for (const char* const phase : {"grid", "bullet_dbvt", "bullet_sap", "fcl_tree", "brute_force"}) {
    for (const int threads : {1, 2}) {
      EXPECT_TRUE(same_bits(contacts_of(scene, phase, threads), expected)) << phase << ", threads " << threads;
    }
  }
}

// Law: no two surfaces that overlap are missed: single spheres against each other, by comparing all.
TEST(CollisionPhases, every_overlap_of_spheres_is_found) {
  const Scene scene;
  const BodyView view = scene.bodies.view();
  const auto radius = [&](std::size_t i) {
    const Primitive& p = scene.shapes.primitives(scene.shapes.shapes()[view.shape[i]])[0];
    return p.kind == ShapeKind::sphere ? p.size.x : -1.0;
  };
  std::size_t expected = 0;
  for (std::size_t i = 0; i < view.size(); ++i) {
    for (std::size_t j = i + 1; j < view.size(); ++j) {
      if (radius(i) < 0.0 || radius(j) < 0.0) continue;
      expected += norm(view.position[i] - view.position[j]) < radius(i) + radius(j);
    }
  }
  std::size_t found = 0;
  for (const Contact& c : contacts_of(scene, "grid", 2))
    found += c.gap < 0.0 && radius(c.a) >= 0.0 && radius(c.b) >= 0.0;
  EXPECT_GT(expected, 50u);
  EXPECT_EQ(found, expected);
}

/// Spheres over two planes, one of which turns; some of them fixed, one lost.
Scene scene_of_spheres(bool planes) {
  Scene scene{Scene::Empty{}};
  for (int i = 0; i < 2000; ++i) {
    if (planes && i == 700) scene.add(shape_data(plane_data()), {{0, 0, -0.1}, {}}, Motion::fixed);
    if (planes && i == 900) scene.add(shape_data(plane_data()), scene.random.pose(0.05), Motion::kinematic);
    const double radius = i % 50 == 0 ? 3e-2 : scene.random.uniform(4e-3, 8e-3);
    scene.add(shape_data(sphere_data(radius)), scene.random.pose(0.12), i % 9 == 0 ? Motion::fixed : Motion::dynamic);
  }
  Pose lost;
  lost.position.x = std::numeric_limits<double>::quiet_NaN();
  scene.add(shape_data(sphere_data(5e-3)), lost);
  return scene;
}

// Law: the same of spheres alone, of which a phase may take the balls without boxes, and of spheres and planes.
TEST(CollisionPhases, contacts_of_spheres_do_not_depend_on_phase_or_threads) {
  for (const bool planes : {false, true}) {
    const Scene scene = scene_of_spheres(planes);
    const std::vector<Contact> expected = contacts_of(scene, "brute_force", 1);
    EXPECT_GT(expected.size(), 1000u);
    for (const char* const phase : {"grid", "bullet_dbvt", "bullet_sap", "fcl_tree"}) {
      for (const int threads : {1, 2}) {
        EXPECT_TRUE(same_bits(contacts_of(scene, phase, threads), expected)) << phase << ", threads " << threads;
      }
    }
  }
}

}  // namespace
}  // namespace scree
