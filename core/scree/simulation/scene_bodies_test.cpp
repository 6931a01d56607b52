// Bodies as a scene writes them.
#include <gtest/gtest.h>

#include "scree/config/scene_document.hpp"
#include "scree/model/body_store.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/testing_catalog.hpp"

namespace scree {
namespace {

using testing_parts::Catalog;
using testing_parts::scene;

// About the origin of the shape: at the centre of a sphere that lies at (1, 0, 0) of its shape the surface has w x r more.
TEST(scene_bodies, surface_velocities_are_those_of_the_shape_as_written) {
  const Catalog catalog;
  const std::string belts =
      "[shape.offset]\ntype = 'sphere'\nradius = 0.1\nposition = [1.0, 0.0, 0.0]\n"
      "[[body]]\nshape = 'ball'\nmaterial = 'stone'\n"
      "[[body]]\nshape = 'offset'\nmaterial = 'stone'\nmotion = 'dynamic'\nposition = [5.0, 0.0, 0.0]\n"
      "surface_velocity = [0.5, 0.0, 0.0]\nsurface_angular_velocity = [0.0, 0.0, 2.0]\n";
  const SceneDocument document = SceneDocument::parse(scene(belts));
  const Simulation simulation{document, catalog, {}};
  const BodyView bodies = simulation.bodies().view();
  ASSERT_EQ(bodies.surface_motion.size(), 2u);
  EXPECT_EQ(bodies.surface_motion[0], Twist{});
  EXPECT_NEAR(bodies.position[1].x, 6.0, 1e-15);
  const Twist world = surface_motion(bodies, 1);
  EXPECT_LT(norm(world.linear - Vec3{0.5, 2.0, 0.0}), 1e-14);
  EXPECT_LT(norm(world.angular - Vec3{0.0, 0.0, 2.0}), 1e-14);
}

TEST(scene_bodies, scenes_without_a_conveyor_have_no_surface_motions) {
  const Catalog catalog;
  const SceneDocument document = SceneDocument::parse(scene("[[body]]\nshape = 'ball'\nmaterial = 'stone'\n"));
  const Simulation simulation{document, catalog, {}};
  EXPECT_TRUE(simulation.bodies().view().surface_motion.empty());
}

}  // namespace
}  // namespace scree
