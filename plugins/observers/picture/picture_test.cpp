#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "picture_observer.hpp"
#include "scree/config/validate.hpp"
#include "scree/model/material.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

namespace fs = std::filesystem;

PictureObserver make(const std::string& options) {
  return PictureObserver{options_from_text(options, PictureObserver::parameters())};
}

class PictureObserverTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("scree_picture_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const char* name : {"steel", "metal", "plastic"}) services.materials().add({name, 1000.0, {}, {}});
    services.step = 0.1;
    services.add_body("roll_<1>", {.id = 0, .pose = {}, .shape = ""});
    add_shape(ShapeKind::cylinder, {0.16, 0.15, 0});
    add_shape(ShapeKind::sphere, {0.01, 0, 0});
    add_shape(ShapeKind::plane, {});
    bodies.add_immovable(0, {});
    bodies.angular_velocity[0] = {0, 0, -4};
    bodies.add_immovable(1, {0, -0.3, 0});
    bodies.shape[1] = 2;
    bodies.orientation[1] = rotation_between({0, 0, 1}, {0, 1, 0});
    for (int i = 0; i < 3; ++i) {
      bodies.add_sphere(2 + static_cast<BodyId>(i), {0.1 * i, 0.2, -0.1 * i}, 0.01, 1000.0, {0, -2, 0});
      bodies.shape.back() = 1;
      bodies.material.back() = i == 0 ? 2 : 1;
    }
  }
  void TearDown() override {
    EXPECT_EQ(services.unclaimed_in(folder), std::vector<std::string>{});
    fs::remove_all(folder);
  }

  void add_shape(ShapeKind kind, const Vec3& size) {
    PrimitiveData data;
    data.primitive.kind = kind;
    data.primitive.size = size;
    ShapeData shape;
    shape.primitives = {data};
    services.shapes().add(shape);
  }
  [[nodiscard]] Observation at(std::uint64_t step) const {
    return {bodies.view(), {}, {}, 0.1 * static_cast<double>(step), 0.1, step};
  }
  [[nodiscard]] Picture scene(const View& view) {
    return scene_picture(at(0), {services.shapes(), services.materials(), services.body_names()}, view);
  }
  void run(const std::string& options, std::uint64_t steps) {
    PictureObserver observer = make(options);
    observer.setup(services, folder);
    for (std::uint64_t step = 1; step <= steps; ++step) observer.observe(at(step), services.attributes());
    observer.finish(at(steps));
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in{folder / name, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
  }

  fs::path folder;
  test::FakeSceneServices services;
  test::TestBodies bodies{services.attributes()};
};

// A big-endian number of four bytes.
std::size_t number_at(const std::string& bytes, std::size_t place) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[place + i]);
  return value;
}

TEST_F(PictureObserverTest, of_a_scene_has_walls_with_names_and_grains_from_back_to_front) {
  const Picture seen = scene({});
  ASSERT_EQ(seen.walls.size(), 1u);
  EXPECT_EQ(seen.walls[0].label, "roll <1>");
  ASSERT_EQ(seen.grains.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(seen.grains[i].shape.depth, -0.2 + 0.1 * static_cast<double>(i));
  ASSERT_EQ(seen.legend.size(), 2u);
  EXPECT_EQ(seen.legend[0].label, "metal (2)");
  EXPECT_EQ(seen.legend[1].label, "plastic (1)");
  // Materials of walls come last among the colours.
  EXPECT_EQ(seen.colours, (std::vector<std::size_t>{2, 0, 1}));
}

// Grains at z = 0, -0.1, -0.2; the roll about the origin.
TEST_F(PictureObserverTest, leaves_out_what_is_cut_away_and_what_is_hidden) {
  const auto view = [&](const std::string& options) {
    View made;
    made.cut.setup(options_from_text(options, CutView::parameters()), services);
    return made;
  };
  const Picture cut = scene(view("plane = [{ point = [0, 0, -0.05], normal = [0, 0, 1] }]"));
  EXPECT_EQ(cut.grains.size(), 2u);
  EXPECT_TRUE(cut.walls.empty());
  const Picture slice = scene(view("plane = [{ point = [0, 0, -0.095], normal = [0, 0, 1], show = 'cut' }]"));
  EXPECT_EQ(slice.grains.size(), 1u);
  EXPECT_EQ(slice.walls.size(), 1u);
  const Picture hidden = scene(view("hide = ['roll_<1>']"));
  EXPECT_TRUE(hidden.walls.empty());
  EXPECT_EQ(hidden.grains.size(), 3u);
}

TEST_F(PictureObserverTest, shows_the_sense_of_a_turning_cylinder_as_the_viewer_sees_it) {
  const Picture front = scene({});
  ASSERT_EQ(front.turns.size(), 1u);
  EXPECT_FALSE(front.turns[0].counterclockwise);
  EXPECT_EQ(front.turns[0].radius, 0.16);
  EXPECT_TRUE(scene({.projection = {{-1, 0, 0}, {0, 1, 0}}, .window = {}}).turns[0].counterclockwise);
  EXPECT_TRUE(scene({.projection = {{1, 0, 0}, {0, 0, 1}}, .window = {}}).turns.empty());  // seen from the side
}

TEST_F(PictureObserverTest, shows_a_plane_from_the_side_as_an_edge_and_from_above_not_at_all) {
  const Picture side = scene({});
  ASSERT_EQ(side.edges.size(), 1u);
  EXPECT_NEAR(side.edges[0].normal.y, 1.0, 1e-12);  // some roundings of the rotation
  EXPECT_NEAR(side.edges[0].point.y, -0.3, 1e-15);
  EXPECT_TRUE(scene({.projection = {{1, 0, 0}, {0, 0, -1}}, .window = {}}).edges.empty());
}

TEST_F(PictureObserverTest, arrows_reach_where_a_particle_would_be) {
  const Picture seen = scene({.window = {}, .velocity_arrows = 0.05});
  ASSERT_EQ(seen.arrows.size(), 3u);
  for (const Arrow& arrow : seen.arrows) EXPECT_NEAR(arrow.to.y - arrow.from.y, -2.0 * 0.05, 1e-15);
}

TEST_F(PictureObserverTest, png_has_its_signature_and_the_size_that_the_window_gives) {
  run("lower = [-0.2, -0.4]\nupper = [0.6, 0.4]\nwidth = 586", 3);
  const std::string png = read("picture_scene.png");
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(number_at(png, 16), 586u);
  // Margins of 86 px beside the frame leave 500 px for 0.8 m; above and below it they are 136 px.
  EXPECT_EQ(number_at(png, 20), 636u);
}

TEST_F(PictureObserverTest, svg_is_well_formed_xml) {
  run("svg = true\ntitle = 'a < b & c'\nvelocity_arrows = 0.01\n"
      "line = [{ from = [-0.2, -0.2, 0], to = [0.2, -0.2, 0], divisions = 4, label = 'bins' }]",
      1);
  const std::string command =
      "/usr/bin/python3 -c \"import sys, xml.dom.minidom as d; assert d.parse(sys.argv[1]).documentElement.tagName == "
      "'svg'\" " +
      (folder / "picture_scene.svg").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(PictureObserverTest, is_drawn_at_the_interval_and_is_the_same_file_each_time) {
  run("interval = 0.2\nsvg = true\nat_end = false", 4);
  EXPECT_TRUE(fs::exists(folder / "picture_scene_00000002.png"));
  EXPECT_FALSE(fs::exists(folder / "picture_scene_00000003.png"));
  EXPECT_FALSE(fs::exists(folder / "picture_scene.png"));
  const std::string first = read("picture_scene_00000002.svg");
  run("interval = 0.2\nsvg = true\nat_end = false", 2);
  EXPECT_EQ(read("picture_scene_00000002.svg"), first);
}

TEST_F(PictureObserverTest, writes_nothing_without_a_folder) {
  PictureObserver observer = make("interval = 0.1");
  observer.setup(services, {});
  observer.observe(at(1), services.attributes());
  observer.finish(at(1));
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(PictureObserverTest, of_no_bodies_can_be_drawn) {
  bodies = test::TestBodies{services.attributes()};
  run("", 1);
  EXPECT_TRUE(fs::exists(folder / "picture_scene.png"));
}

TEST(picture_options, views_and_windows_that_make_no_picture_are_refused) {
  EXPECT_THROW(make("right = [1, 0, 0]"), Error);
  EXPECT_THROW(make("right = [1, 0, 0]\nup = [1, 0, 0]"), Error);
  EXPECT_THROW(make("right = [2, 0, 0]\nup = [0, 1, 0]"), Error);
  EXPECT_THROW(make("lower = [0, 0]"), Error);
  EXPECT_THROW(make("lower = [0, 0]\nupper = [1, 0]"), Error);
  EXPECT_THROW(make("lower = [0, 0]\nupper = [1, 0.01]"), Error);
  EXPECT_NO_THROW(make("right = [0.6, 0.8, 0]\nup = [0, 0, 1]\nlower = [0, 0]\nupper = [1, 0.2]"));
}

}  // namespace
}  // namespace scree
