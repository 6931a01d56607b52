#include "fill.hpp"

#include <cmath>
#include <set>

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

// The places of 200 equal spheres of 8 mm, filled along `up`, less the corners of the smallest cells that hold them [m].
std::vector<Vec3> moved(const std::string& up, const std::string& upper, double& gap) {
  FeedScene scene;
  const auto fill =
      scene.make<Fill>("count = 200\nlower = [0, 0, 0]\nupper = " + upper + "\nup = '" + up +
                       "'\nfamilies = [{name = 'a', material = 'plastic', size = 8e-3, shape = 'sphere'}]\n");
  std::vector<Vec3> places;
  for (const NewBody& body : scene.emit(*fill, 0)) places.push_back(body.pose.position);
  gap = testing_feed::smallest_gap(scene, 200);
  return places;
}

// How many different coordinates there are along an axis, to a ten-thousandth of a diameter.
std::size_t planes(const std::vector<Vec3>& places, int axis) {
  std::set<long> found;
  for (const Vec3& at : places) found.insert(std::lround(at[axis] / 8e-7));
  return found.size();
}

// 200 draws from some 600 places of a ten-thousandth a layer hardly ever coincide in more than half; rows give 8 planes.
TEST(fill, equal_spheres_lie_in_no_rows_along_any_axis) {
  for (const char* const up : {"x", "y", "z"}) {
    double gap = -1.0;
    const std::vector<Vec3> places = moved(up, "[0.07, 0.07, 0.07]", gap);
    ASSERT_EQ(places.size(), 200U);
    EXPECT_GE(gap, 0.0);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GT(planes(places, axis), 100U) << up << axis;
      for (const Vec3& at : places) {
        ASSERT_GE(at[axis], 4e-3);
        ASSERT_LE(at[axis], 0.07 - 4e-3);
      }
    }
  }
}

TEST(fill, equal_spheres_are_moved_as_far_as_a_tight_box_lets_them) {
  double gap = -1.0;
  // 5 x 5 x 8 cells of 8 mm with 2 % to spare across: an eighth of the play is 1 %.
  const std::vector<Vec3> tight = moved("z", "[0.0408, 0.0408, 0.0656]", gap);
  ASSERT_EQ(tight.size(), 200U);
  EXPECT_GE(gap, 0.0);
  EXPECT_GT(planes(tight, 0), 100U);
  // Room for 200, exactly.
  const std::vector<Vec3> full = moved("z", "[0.0401, 0.0401, 0.0641]", gap);
  ASSERT_EQ(full.size(), 200U);
  EXPECT_GE(gap, 0.0);
  EXPECT_EQ(planes(full, 0), 5U);
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
