#include "scree/simulation/shape_builder.hpp"

#include <gtest/gtest.h>

#include "scree/base/error.hpp"
#include "scree/config/validate.hpp"
#include "scree/simulation/scene_sections.hpp"

namespace scree {
namespace {

/// A tetrahedron with corners at the origin and at 1 m along each axis: volume 1/6 m3.
const std::string kCorners = "vertices = [0,0,0, 1,0,0, 0,1,0, 0,0,1]\n";
const std::string kFaces = "triangles = [0,2,1, 0,1,3, 0,3,2, 1,2,3]\n";

struct Built {
  ShapeData shape;
  ShapeRemarks remarks;
};

Built build(const std::string& type, const std::string& toml, ShapeFrame frame) {
  for (const Variant& variant : shape_variants()) {
    if (variant.type != type) continue;
    Options options = options_from_text(toml, variant.members);
    options.set_type(type);
    Built built;
    built.shape = build_shape("thing", options, frame, built.remarks);
    return built;
  }
  throw std::logic_error{type};
}

std::string refusal(const std::string& type, const std::string& toml, ShapeFrame frame = ShapeFrame::principal) {
  try {
    (void)build(type, toml, frame);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_holds(const std::string& text, const std::string& words) {
  EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST(shape_builder, a_sound_mesh_gives_a_solid_without_remarks) {
  const Built built = build("triangle_mesh", kCorners + kFaces, ShapeFrame::principal);
  EXPECT_NEAR(built.shape.volume, 1.0 / 6.0, 1e-15);
  EXPECT_TRUE(built.remarks.notes.empty() && built.remarks.warnings.empty());
}

TEST(shape_builder, an_open_mesh_is_a_wall_with_a_note_but_no_moving_body) {
  const std::string open = kCorners + "triangles = [0,2,1, 0,1,3, 0,3,2]\n";
  expect_holds(refusal("triangle_mesh", open), "3 edges have one triangle only");
  const Built wall = build("triangle_mesh", open, ShapeFrame::as_written);
  ASSERT_EQ(wall.remarks.notes.size(), 1u);
  expect_holds(wall.remarks.notes[0], "'thing' is open at 3 edges");
  EXPECT_TRUE(wall.remarks.warnings.empty());
}

TEST(shape_builder, a_turned_triangle_is_a_wall_with_a_warning_but_no_moving_body) {
  const std::string turned = kCorners + "triangles = [0,1,2, 0,1,3, 0,3,2, 1,2,3]\n";
  expect_holds(refusal("triangle_mesh", turned), "unify the normals");
  const Built wall = build("triangle_mesh", turned, ShapeFrame::as_written);
  ASSERT_EQ(wall.remarks.warnings.size(), 1u);
  expect_holds(wall.remarks.warnings[0], "used as it is");
}

TEST(shape_builder, a_mesh_inside_out_is_turned_for_both_with_a_warning) {
  const std::string inside_out = kCorners + "triangles = [0,1,2, 0,3,1, 0,2,3, 1,3,2]\n";
  for (const ShapeFrame frame : {ShapeFrame::principal, ShapeFrame::as_written}) {
    const Built built = build("triangle_mesh", inside_out, frame);
    EXPECT_NEAR(built.shape.volume, 1.0 / 6.0, 1e-15);
    ASSERT_EQ(built.remarks.warnings.size(), 1u);
    expect_holds(built.remarks.warnings[0], "taken the right way round");
  }
}

TEST(shape_builder, triangles_without_an_area_are_left_out_of_walls_and_refused_in_moving_bodies) {
  const std::string sliver =
      "vertices = [0,0,0, 1,0,0, 0,1,0, 0,0,1, 0.5,0,0]\n"
      "triangles = [0,2,1, 0,1,3, 0,3,2, 1,2,3, 0,4,1]\n";
  expect_holds(refusal("triangle_mesh", sliver), "1 triangle has no area");
  const Built wall = build("triangle_mesh", sliver, ShapeFrame::as_written);
  EXPECT_EQ(wall.shape.primitives[0].triangles.size(), 4u);
  ASSERT_EQ(wall.remarks.warnings.size(), 1u);
  expect_holds(wall.remarks.warnings[0], "left out");
}

TEST(shape_builder, two_tetrahedra_that_cross_are_a_wall_but_no_moving_body) {
  const std::string crossing =
      "vertices = [0,0,0, 1,0,0, 0,1,0, 0,0,1, 0.1,0.1,0.1, 1.1,0.1,0.1, 0.1,1.1,0.1, 0.1,0.1,1.1]\n"
      "triangles = [0,2,1, 0,1,3, 0,3,2, 1,2,3, 4,6,5, 4,5,7, 4,7,6, 5,6,7]\n";
  expect_holds(refusal("triangle_mesh", crossing), "passes through itself");
  expect_holds(build("triangle_mesh", crossing, ShapeFrame::as_written).remarks.warnings.at(0), "unite its parts");
}

TEST(shape_builder, spheres_stand_for_a_solid_and_its_mass_stays) {
  const std::string hull = "points = [0,0,0, 1,0,0, 0,1,0, 0,0,1, 1,1,1]\n";
  const Built solid = build("convex_hull", hull, ShapeFrame::principal);
  const Built cluster = build("convex_hull", hull + "spheres = 4\n", ShapeFrame::principal);
  EXPECT_EQ(cluster.shape.volume, solid.shape.volume);
  EXPECT_EQ(cluster.shape.unit_inertia, solid.shape.unit_inertia);
  EXPECT_EQ(cluster.shape.body_to_shape, solid.shape.body_to_shape);
  EXPECT_EQ(cluster.shape.primitives[0].primitive.kind, ShapeKind::sphere_cluster);
  EXPECT_EQ(cluster.shape.primitives[0].spheres.size(), 4u);
  EXPECT_EQ(cluster.remarks.notes.size() + cluster.remarks.warnings.size(), 1u);
  const Built mesh = build("triangle_mesh", kCorners + kFaces + "spheres = 2\n", ShapeFrame::principal);
  EXPECT_NEAR(mesh.shape.volume, 1.0 / 6.0, 1e-15);
  expect_holds(refusal("triangle_mesh", kCorners + "triangles = [0,2,1]\nspheres = 2\n", ShapeFrame::as_written),
               "need a solid to stand for");
}

TEST(shape_builder, a_cluster_can_state_the_solid_that_it_stands_for) {
  // A brick of 1 x 2 x 3 m, written away from its centre and turned by nothing: closed forms of volume and inertia.
  const Built built = build("sphere_cluster",
                            "spheres = [{ centre = [1, 2, 3], radius = 0.5 }, { centre = [1.2, 2, 3], radius = 0.4 }]\n"
                            "solid = { volume = 6, centre = [1, 2, 3], inertia = [6.5, 5, 2.5, 0, 0, 0] }\n",
                            ShapeFrame::principal);
  EXPECT_EQ(built.shape.volume, 6.0);
  EXPECT_NEAR(norm(built.shape.unit_inertia - Vec3{6.5, 5, 2.5}), 0.0, 1e-14);
  EXPECT_EQ(built.shape.body_to_shape.position, (Vec3{1, 2, 3}));
  expect_holds(refusal("sphere_cluster",
                       "spheres = [{ centre = [0,0,0], radius = 1 }]\n"
                       "solid = { volume = 1, inertia = [1, 1, 3, 0, 0, 0] }\n"),
               "larger than the sum of the other two");
}

TEST(shape_builder, a_heightfield_becomes_a_mesh_and_says_when_its_size_is_wrong) {
  const std::string heights = "heights = [0, 0.1, 0.2, 0, 0.1, 0.2]\ncolumns = 3\nspacing = \"10 mm\"\n";
  const Built wall = build("heightfield", heights, ShapeFrame::as_written);
  EXPECT_EQ(wall.shape.primitives[0].primitive.kind, ShapeKind::triangle_mesh);
  EXPECT_EQ(wall.shape.primitives[0].triangles.size(), 4u);
  EXPECT_EQ(wall.remarks.notes.size(), 1u) << "open";
  expect_holds(refusal("heightfield", heights), "one triangle only");
  const Built solid = build("heightfield", heights + "base = -0.1\n", ShapeFrame::principal);
  EXPECT_NEAR(solid.shape.volume, 0.02 * 0.01 * 0.2, 1e-15);  // area times mean height above the base
  expect_holds(refusal("heightfield", "heights = [0, 0.1, 0.2, 0]\ncolumns = 3\nspacing = 0.01\n"),
               "3 columns and 2 rows needs 6 heights, but has 4");
  expect_holds(refusal("heightfield", "heights = [0, 0.1, 0.2, 0]\nspacing = 0.01\n"), "needs 'columns'");
  expect_holds(refusal("heightfield", "spacing = 0.01\n"), "needs either 'heights' or 'file'");
}

}  // namespace
}  // namespace scree
