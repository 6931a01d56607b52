// Views that are cut: areas and counts that follow from geometry.
#include "vtp/cut_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scree/config/validate.hpp"
#include "support/fake_scene_services.hpp"
#include "support/test_bodies.hpp"

namespace scree {
namespace {

CutView view_of(const std::string& toml, test::FakeSceneServices& services) {
  CutView view;
  view.setup(options_from_text(toml, CutView::parameters()), services);
  return view;
}

double area(const Surface& surface) {
  double sum = 0.0;
  for (const auto& t : surface.triangles) {
    const Vec3& a = surface.points[t[0]];
    sum += 0.5 * norm(cross(surface.points[t[1]] - a, surface.points[t[2]] - a));
  }
  return sum;
}

// A square of 2 m about the origin in z = 0, as two triangles.
Surface square() { return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}; }

TEST(cut_view, everything_is_shown_by_default) {
  test::FakeSceneServices services;
  const CutView view = view_of("", services);
  EXPECT_TRUE(view.keeps({1e9, -1e9, 0}, 0.1));
  Surface surface = square();
  view.clip(surface, 0);
  EXPECT_EQ(surface.triangles.size(), 2u);
}

TEST(cut_view, a_plane_takes_its_side_away) {
  test::FakeSceneServices services;
  const CutView view = view_of("plane = [{ point = [0.5, 0, 0], normal = [2, 0, 0] }]", services);
  EXPECT_TRUE(view.keeps({0.4, 0, 0}, 0.2));
  EXPECT_FALSE(view.keeps({0.6, 0, 0}, 0.2));
  Surface surface = square();
  view.clip(surface, 0);
  EXPECT_NEAR(area(surface), 1.5 * 2.0, 1e-15);
  // What was there before stays.
  Surface second = square();
  view.clip(second, 1);
  EXPECT_NEAR(area(second), 2.0 + (2.0 - 0.125), 1e-15);  // of the upper triangle the corner of 0.5 m is gone
}

TEST(cut_view, a_plane_shows_what_it_cuts) {
  test::FakeSceneServices services;
  const CutView view = view_of("plane = [{ point = [0, 0, 0], normal = [0, 0, 1], show = 'cut' }]", services);
  EXPECT_TRUE(view.keeps({5, 5, 0.1}, 0.2));
  EXPECT_TRUE(view.keeps({5, 5, -0.1}, 0.2));
  EXPECT_FALSE(view.keeps({5, 5, -0.3}, 0.2));
  EXPECT_TRUE(view.keeps_point({5, 5, -0.3}));
  Surface surface{{{0, 0, -1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 3}}, {{0, 1, 2}, {1, 2, 3}}};
  view.clip(surface, 0);
  EXPECT_EQ(surface.triangles.size(), 1u);
}

TEST(cut_view, a_box_and_a_cylinder_keep_what_is_inside) {
  test::FakeSceneServices services;
  const CutView box = view_of("region = { type = 'box', lower = [-0.5, -0.25, -1], upper = [0.5, 0.25, 1] }", services);
  EXPECT_TRUE(box.keeps({0.4, 0.2, 0.9}, 0.0));
  EXPECT_FALSE(box.keeps({0.4, 0.3, 0.9}, 0.0));
  Surface surface = square();
  box.clip(surface, 0);
  EXPECT_NEAR(area(surface), 0.5, 1e-15);
  drop_unused_points(surface);
  EXPECT_NEAR(area(surface), 0.5, 1e-15);
  for (const Vec3& p : surface.points) EXPECT_LE(std::abs(p.x), 0.5);
  const CutView cylinder =
      view_of("region = { type = 'cylinder', from = [0, 0, 0], to = [0, 0, 2], radius = 0.5 }", services);
  EXPECT_TRUE(cylinder.keeps({0.3, 0.3, 1.9}, 0.0));
  EXPECT_FALSE(cylinder.keeps({0.4, 0.4, 1.0}, 0.0));
  EXPECT_FALSE(cylinder.keeps({0, 0, 2.1}, 0.0));
}

TEST(cut_view, bodies_are_hidden_and_shown_as_walls_by_name) {
  test::FakeSceneServices services;
  services.add_body("lid", {1, {}, {}});
  services.add_body("drum", {2, {}, {}});
  const CutView view = view_of("hide = ['lid']\nas_walls = ['drum']", services);
  EXPECT_TRUE(view.hides(1));
  EXPECT_FALSE(view.hides(2));
  test::TestBodies bodies{services.attributes()};
  bodies.add_immovable(1, {});
  bodies.add_sphere(2, {}, 1.0, 1.0);
  bodies.add_sphere(3, {}, 1.0, 1.0);
  EXPECT_TRUE(view.is_wall(bodies.view(), 0));
  EXPECT_TRUE(view.is_wall(bodies.view(), 1));
  EXPECT_FALSE(view.is_wall(bodies.view(), 2));
}

TEST(cut_view, what_cannot_cut_is_refused) {
  test::FakeSceneServices services;
  for (const char* wrong : {"hide = ['nobody']", "plane = [{ point = [0, 0, 0], normal = [0, 0, 0] }]",
                            "region = { type = 'box', lower = [0, 0, 0], upper = [1, 0, 1] }",
                            "region = { type = 'cylinder', from = [0, 0, 0], to = [0, 0, 0], radius = 1 }"}) {
    EXPECT_THROW(view_of(wrong, services), Error) << wrong;
  }
}

}  // namespace
}  // namespace scree
