#include "fill.hpp"

#include "scree/base/error.hpp"
#include "scree/state/memory_state.hpp"
#include "testing_feed.hpp"

namespace scree {
namespace {

using testing_feed::FeedScene;

const std::string kMixed =
    "families = [{name = 'a', material = 'plastic', size = {type = 'uniform', min = 2e-3, max = 8e-3}, shape = "
    "'sphere'}, {name = 'b', material = 'copper', size = 3e-3, shape = {type = 'shaving', aspect = 3}}]\n";
const std::string kBox = "lower = [0, 0, 0]\nupper = [0.1, 0.06, 0.4]\n";

TEST(fill, places_all_particles_in_the_box_and_apart) {
  FeedScene scene;
  const auto fill = scene.make<Fill>("count = 300\n" + kBox + kMixed);
  ASSERT_EQ(scene.emit(*fill, 0).size(), 300U);
  EXPECT_GE(testing_feed::smallest_gap(scene, 300), 0.0);
  const BodyView view = scene.bodies.view();
  for (std::size_t i = 0; i < view.size(); ++i) {
    for (const Sphere& s :
         testing_feed::world_spheres(scene.services.shapes(), view.shape[i], {view.position[i], view.orientation[i]})) {
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_GE(s.centre[axis] - s.radius, 0.0);
        ASSERT_LE(s.centre[axis] + s.radius, (Vec3{0.1, 0.06, 0.4})[axis]);
      }
    }
  }
  EXPECT_TRUE(scene.emit(*fill, 1).empty());  // once
}

TEST(fill, rises_along_the_axis_of_the_scene) {
  for (const int up : {0, 1, 2}) {
    FeedScene scene;
    const auto fill = scene.make<Fill>("count = 50\nlower = [0, 0, 0]\nupper = [0.1, 0.1, 0.1]\nup = '" +
                                       std::string(1, static_cast<char>('x' + up)) + "'\n" + kMixed);
    // 144 cells a layer at least, if the cell is the largest particle of 8 mm: one layer.
    for (const NewBody& body : scene.emit(*fill, 0)) EXPECT_LE(body.pose.position[up], 8e-3);
  }
}

TEST(fill, passes_over_cells_that_hold_a_body) {
  FeedScene scene;
  const auto first = scene.make<Fill>("count = 200\n" + kBox + kMixed);
  const auto second = scene.make<Fill>("count = 200\n" + kBox + kMixed);
  scene.emit(*first, 0);
  ASSERT_EQ(scene.emit(*second, 0).size(), 200U);
  EXPECT_GE(testing_feed::smallest_gap(scene, 200), 0.0);
}

TEST(fill, refuses_a_box_without_room) {
  FeedScene scene;
  EXPECT_THROW(scene.make<Fill>("count = 100000\n" + kBox + kMixed), Error);
  const auto first = scene.make<Fill>("count = 3000\n" + kBox + kMixed);
  const auto second = scene.make<Fill>("count = 3000\n" + kBox + kMixed);
  scene.emit(*first, 0);
  EXPECT_THROW(scene.emit(*second, 0), Error);  // full of the first
}

TEST(fill, does_not_fill_again_after_a_restart) {
  FeedScene scene;
  const std::string text = "count = 10\n" + kBox + kMixed;
  const auto before = scene.make<Fill>(text), after = scene.make<Fill>(text);
  scene.emit(*before, 0);
  MemoryState saved;
  before->save(saved.writer());
  after->load(saved.reader());
  EXPECT_TRUE(scene.emit(*after, 1).empty());
}

}  // namespace
}  // namespace scree
