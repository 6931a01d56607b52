#include "analysis/region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

TEST(region, holds_everything_when_the_scene_names_none) {
  test::FakeSceneServices services;
  const Region region{options_from_text("", {Region::parameter()}), services};
  EXPECT_TRUE(region.contains({1e9, -1e9, 0}));
}

// A drum that stands at (1, 0, 0) and has turned by a quarter about z: its x is the world's y.
TEST(region, moves_with_its_body) {
  test::FakeSceneServices services;
  services.add_body("drum", {3, {}, "drum"});
  Region region{options_from_text("region = {lower = [0, -0.1, -0.1], upper = [2, 0.1, 0.1], frame = 'drum'}",
                                  {Region::parameter()}),
                services};
  test::TestBodies bodies{services.attributes()};
  bodies.add_sphere(1, {}, 1e-3, 1000.0);
  bodies.add_immovable(3, {1, 0, 0});
  bodies.orientation[1] = from_rotation_vector({0, 0, std::numbers::pi / 2});
  region.update(bodies.view());
  EXPECT_TRUE(region.contains({1, 1.9, 0}));
  EXPECT_FALSE(region.contains({1.9, 0, 0}));
  EXPECT_NEAR(region.local({1, 1.5, 0}).x, 1.5, 1e-15);  // a rotation rounds to a few units of the last place
  test::TestBodies gone{services.attributes()};
  region.update(gone.view());
  EXPECT_FALSE(region.contains({1, 1.9, 0})) << "nothing lies in the frame of a body that is gone";
}

// The scene writes places in the frame of the shape; the body frame has another origin and other axes.
TEST(region, lies_in_the_frame_of_the_shape_as_written) {
  test::FakeSceneServices services;
  const Pose body_to_shape{{0.5, 0, 0}, from_rotation_vector({0, 0, std::numbers::pi / 2})};
  services.shapes().add({"wedge", {}, 1.0, {1, 1, 1}, body_to_shape});
  const Pose scene{{10, 0, 0}, {}};  // where the scene puts the shape
  services.add_body("wedge", {1, scene * body_to_shape, "wedge"});
  const Region region{
      options_from_text("region = {lower = [0, 0, 0], upper = [1, 1, 1], frame = 'wedge'}", {Region::parameter()}),
      services};
  EXPECT_TRUE(region.contains({10.9, 0.9, 0.9}));
  EXPECT_FALSE(region.contains({10.9, -0.1, 0.9}));
}

TEST(region, knows_which_part_of_a_way_lies_in_a_box) {
  const Aabb box{{0, 0, 0}, {1, 1, 1}};
  const auto through = part_inside(box, {-1, 0.5, 0.5}, {3, 0.5, 0.5});
  ASSERT_TRUE(through);
  EXPECT_DOUBLE_EQ(through->first, 0.25);
  EXPECT_DOUBLE_EQ(through->second, 0.5);
  const auto inside = part_inside(box, {0.2, 0.2, 0.2}, {0.2, 0.2, 0.2});
  ASSERT_TRUE(inside);
  EXPECT_EQ(*inside, (std::pair{0.0, 1.0}));
  EXPECT_FALSE(part_inside(box, {-1, 0.5, 0.5}, {0.5, 2.5, 0.5})) << "the line passes the corner";
  EXPECT_FALSE(part_inside(box, {-1, 2, 0.5}, {3, 2, 0.5}));
  EXPECT_FALSE(part_inside(box, {std::nan(""), 0.5, 0.5}, {0.5, 0.5, 0.5})) << "nowhere is not inside";
}

TEST(cell_grid, gives_every_place_of_its_box_to_one_cell) {
  const CellGrid grid{{{-1, 0, 0}, {1, 3, 1}}, {2, 3, 1}};
  EXPECT_EQ(grid.size(), 6u);
  EXPECT_EQ(grid.cell({-1, 0, 0}), 0);
  EXPECT_EQ(grid.cell({0.5, 0.5, 0.5}), 1);
  EXPECT_EQ(grid.cell({-0.5, 1.5, 0.5}), 2);
  EXPECT_EQ(grid.cell({1, 3, 1}), 5) << "the upper corner belongs to the last cell";
  EXPECT_EQ(grid.cell({1.01, 3, 1}), -1);
}

TEST(cell_grid, refuses_empty_boxes_and_broken_numbers) {
  test::FakeSceneServices services;
  const auto said = [&](const std::string& toml) -> std::string {
    try {
      (void)CellGrid{options_from_text(toml, {CellGrid::parameter()}), services};
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_NE(said("grid = {lower = [0, 0, 0], upper = [1, 0, 1], cells = [1, 1, 1]}").find("along y"),
            std::string::npos);
  EXPECT_NE(said("grid = {lower = [0, 0, 0], upper = [1, 1, 1], cells = [1, 2.5, 1]}").find("whole numbers"),
            std::string::npos);
  EXPECT_NE(
      said("grid = {lower = [0, 0, 0], upper = [1, 1, 1], cells = [9999, 9999, 9999]}").find("more than the 4000000"),
      std::string::npos);
  EXPECT_NE(said("grid = {lower = [0, 0, 0], upper = [1, 1, 1], cells = [1, 1]}").find('3'), std::string::npos);
}

}  // namespace
}  // namespace scree
