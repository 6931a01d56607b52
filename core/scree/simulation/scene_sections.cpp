#include "scree/simulation/scene_sections.hpp"

#include <stdexcept>
#include <string>

#include "scree/simulation/scene_machine.hpp"
#include "scree/simulation/scene_motion.hpp"

namespace scree {
namespace {

std::vector<Parameter> contact_parameters() {
  return {
      Parameter::number("friction", "1", "coefficient of sliding friction").at_least(0.0).by_default(0.0),
      Parameter::number("restitution", "1", "coefficient of restitution of the normal velocity")
          .at_least(0.0)
          .at_most(1.0)
          .by_default(0.0),
      Parameter::number("rolling_friction", "m", "arm of the rolling torque: at most this times the normal force")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("spinning_friction", "m", "arm of the spinning torque: at most this times the normal force")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("compliance", "m/N",
                        "normal compliance, the inverse of a stiffness; 0 is rigid. In an unlisted pair the two "
                        "materials' add up, so that two bodies of one material touch with twice its value")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("damping", "N s/m", "normal damping of a compliant contact").at_least(0.0).by_default(0.0),
      Parameter::number("surface_energy", "J/m2", "work of adhesion, for contact laws with JKR or DMT cohesion")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("cohesion_energy_density", "J/m3", "attraction per contact area, for contact laws that have it")
          .at_least(0.0)
          .by_default(0.0)};
}

Parameter group_parameter() {
  return Parameter::text("collision_group", "name of a [collision_group.NAME], or 'default'").by_default("default");
}

/// Position and rotation of a part, a primitive or a body.
std::vector<Parameter> pose_parameters() {
  return {Parameter::vector("position", "m", "of the shape's origin").by_default(Vec3{}),
          Parameter::vector("rotation_axis", "1", "axis of the rotation by rotation_angle").by_default(Vec3{0, 0, 1}),
          Parameter::number("rotation_angle", "rad", "angle of the rotation about rotation_axis").by_default(0.0)};
}

std::vector<Parameter> operator+(std::vector<Parameter> a, const std::vector<Parameter>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Parameter length(const char* name, const char* help) { return Parameter::number(name, "m", help).above(0.0); }

/// Primitives that a few lengths describe.
std::vector<Variant> simple_variants(const std::vector<Parameter>& placed) {
  return {
      {"sphere", "A ball.", std::vector<Parameter>{length("radius", "radius")} + placed},
      {"box", "A cuboid.",
       std::vector<Parameter>{Parameter::vector("size", "m", "full edge lengths along x, y and z").above(0.0)} +
           placed},
      {"cylinder", "A cylinder about its z axis, solid or seen from inside.",
       std::vector<Parameter>{
           length("radius", "radius"), length("length", "full length along z"),
           Parameter::boolean("hollow", "the inside is free, mantle and both lids are solid: a closed drum")
               .by_default(false)} +
           placed},
      {"capsule", "A cylinder with round caps about its z axis.",
       std::vector<Parameter>{length("radius", "radius"), length("length", "length of the straight part along z")} +
           placed},
      {"cone", "A cone about its z axis, apex at +z.",
       std::vector<Parameter>{length("radius", "radius of the base"), length("height", "height along z")} + placed},
      {"plane", "The half space below z = 0 of its own frame; unbounded.",
       std::vector<Parameter>{
           Parameter::vector("normal", "1", "outward normal, before the rotation").by_default(Vec3{0, 0, 1})} +
           placed},
      {"ellipsoid", "An ellipsoid with its axes along x, y and z.",
       std::vector<Parameter>{Parameter::vector("semi_axes", "m", "half lengths along x, y, z").above(0.0)} + placed}};
}

/// A rigid union of spheres, on its own or in the place of another solid.
Variant cluster_variant(const std::vector<Parameter>& placed) {
  const Parameter solid =
      Parameter::table(
          "solid",
          {Parameter::number("volume", "m3", "volume").above(0.0),
           Parameter::vector("centre", "m", "centre of mass").by_default(Vec3{}),
           Parameter::numbers("inertia", "m5", "xx, yy, zz, xy, xz, yz about the centre, per unit of density")
               .with_count(6)},
          "the solid that the spheres stand for: its mass and inertia count, not theirs")
          .optional();
  return {"sphere_cluster", "A rigid union of spheres.",
          std::vector<Parameter>{Parameter::tables("spheres",
                                                   {Parameter::vector("centre", "m", "centre of the sphere"),
                                                    length("radius", "radius of the sphere")},
                                                   "the spheres"),
                                 solid} +
              placed};
}

/// Primitives made of points and triangles.
std::vector<Variant> surface_variants(const std::vector<Parameter>& placed) {
  const auto file = [](const char* help) { return Parameter::path("file", help).optional(); };
  const Parameter scale =
      Parameter::number("scale", "1", "factor on the numbers of the file").above(0.0).by_default(1.0);
  const Parameter spheres =
      Parameter::integer("spheres", "collision sees so many spheres in its place; mass and inertia stay")
          .at_least(1)
          .at_most(1000)
          .optional();
  return {
      {"convex_hull", "The convex hull of points.",
       std::vector<Parameter>{
           Parameter::numbers("points", "m", "x, y, z of each point, one after the other").optional(),
           file("STL, OBJ or PLY file with the points"), scale, spheres} +
           placed},
      {"triangle_mesh", "A surface of triangles.",
       std::vector<Parameter>{
           Parameter::numbers("vertices", "m", "x, y, z of each vertex, one after the other").optional(),
           Parameter::numbers("triangles", "1", "three indices of vertices a triangle, from 0, counter-clockwise")
               .optional(),
           file("STL, OBJ or PLY file"), scale, spheres} +
           placed},
      {"heightfield", "Heights over a grid; the first lies at the origin, rows follow each other along y.",
       std::vector<Parameter>{
           Parameter::numbers("heights", "m", "row by row, each along x").optional(),
           Parameter::integer("columns", "heights in a row of `heights`").at_least(2).optional(),
           file("text file of heights, a row a line"), scale, length("spacing", "distance of neighbours in the grid"),
           length("spacing_y", "distance along y; `spacing` when left out").optional(),
           Parameter::number("base", "m", "height of a flat underside, which makes it a closed solid").optional()} +
           placed}};
}

/// Primitives, as parts of compounds or shapes of their own.
std::vector<Variant> primitive_variants(const std::vector<Parameter>& placed) {
  std::vector<Variant> all = simple_variants(placed);
  all.insert(all.begin() + 1, cluster_variant(placed));
  for (Variant& surface : surface_variants(placed)) all.push_back(std::move(surface));
  return all;
}

SceneSection body_section() {
  return {"body", SectionForm::list, "A body that exists from the start.",
          std::vector<Parameter>{
              Parameter::text("name", "by which parts and messages refer to it").by_default(""),
              Parameter::text("shape", "name of a shape"), Parameter::text("material", "name of a material"),
              Parameter::choice("motion", {"dynamic", "kinematic", "fixed"}, "by forces, as told, or not at all")
                  .by_default("fixed"),
              Parameter::vector("velocity", "m/s", "of the centre of mass; of a kinematic body for ever")
                  .by_default(Vec3{}),
              Parameter::vector("angular_velocity", "rad/s", "world frame; of a kinematic body for ever")
                  .by_default(Vec3{}),
              Parameter::vector("surface_velocity", "m/s",
                                "of the surface against the body, in the axes of its shape: a conveyor belt")
                  .by_default(Vec3{}),
              Parameter::vector("surface_angular_velocity", "rad/s",
                                "of the surface against the body, about the origin of its shape: a turntable")
                  .by_default(Vec3{}),
              Parameter::boolean("collides", "false: nothing touches the body").by_default(true), group_parameter(),
              frames_parameter(), Parameter::columns("attributes", {}, "any", "body attributes, in SI").optional()} +
              pose_parameters()};
}

std::vector<SceneSection> model_sections() {
  return {
      {"simulation",
       SectionForm::single,
       "Time and randomness.",
       {Parameter::text("title", "shown in results").by_default(""),
        Parameter::number("end_time", "s", "simulated time at which the run ends").at_least(0.0),
        Parameter::number("time_step", "s", "outer step").above(0.0).by_default(1e-3),
        Parameter::integer("seed", "of all random streams").at_least(0).by_default(1),
        Parameter::number("max_speed", "m/s", "a faster body ends the run as diverged").above(0.0).by_default(1e4),
        Parameter::boolean("allow_overlap", "accept bodies that overlap at the start or when they are born")
            .by_default(false),
        Parameter::boolean("assemble", "move bodies until the joints are together, in place of refusing them")
            .by_default(true)}},
      {"contacts",
       SectionForm::single,
       "What holds between materials that are not listed as a pair.",
       {Parameter::choice("unlisted_pair", {"minimum", "maximum", "mean", "geometric_mean"},
                          "how friction, restitution and damping of two materials combine; compliances add")
            .by_default("minimum")}},
      {"material", SectionForm::named, "A material: [material.steel].",
       std::vector<Parameter>{
           Parameter::number("density", "kg/m3", "mass density").above(0.0).by_default(1000.0),
           Parameter::number("young_modulus", "Pa", "for contact laws of elastic spheres; 0: not known")
               .at_least(0.0)
               .by_default(0.0),
           Parameter::number("poisson_ratio", "1", "the same").at_least(0.0).at_most(0.5).by_default(0.25),
           Parameter::columns("attributes", {}, "any", "body attributes that come with the material, in SI")
               .optional()} +
           contact_parameters()},
      {"material_pair", SectionForm::list, "Contact parameters of two materials.",
       std::vector<Parameter>{Parameter::texts("between", "the two materials").with_count(2)} + contact_parameters()},
      {"shape", SectionForm::named, "A shape: [shape.drum] with `type`.", {}},
      {"collision_group",
       SectionForm::named,
       "A group of bodies: [collision_group.walls]. Two bodies meet when the groups of both collide with the other's.",
       {Parameter::texts("collides_with", "the groups whose bodies the group's meet; all when left out").optional()}},
      {"excluded_pair",
       SectionForm::list,
       "Two bodies that never touch each other, whatever their groups.",
       {Parameter::texts("between", "names of the two bodies").with_count(2)}},
      body_section(),
      {"prescribed_motion", SectionForm::list, "How a kinematic body moves, as functions of time or along a path.",
       prescribed_motion_parameters()}};
}

std::vector<SceneSection> part_sections() {
  const Parameter name = Parameter::text("name", "of this part; its type when left out").by_default("");
  return {
      {"time_stepper", SectionForm::at_most_one_plugin, "How a step is taken.", {}},
      {"ccp_solver",
       SectionForm::at_most_one_plugin,
       "Solves the contact problem of a step.",
       {Parameter::number("tolerance", "m/s", "stop at this residual of the contact problem")
            .at_least(0.0)
            .by_default(1e-3),
        Parameter::integer("max_iterations", "stop after so many iterations").at_least(1).by_default(100),
        Parameter::boolean("active_set",
                           "put aside contacts that the guess leaves open, until a solve would close them")
            .by_default(true)}},
      {"contact_law", SectionForm::at_most_one_plugin, "Forces of soft contacts, for steppers that need them.", {}},
      {"broad_phase", SectionForm::at_most_one_plugin, "Finds pairs of boxes that meet.", {}},
      {"narrow_phase", SectionForm::plugin_list, "Computes contacts; the first that supports a pair gets it.", {name}},
      {"electric_field", SectionForm::plugin_list, "Fields that force fields look up by name.", {name}},
      {"force_field", SectionForm::plugin_list, "Forces on bodies, advanced in this order.", {name}},
      {"source", SectionForm::plugin_list, "Feeds of bodies.", {name, group_parameter()}},
      {"sink", SectionForm::plugin_list, "What takes bodies out.", {name}},
      {"observer", SectionForm::plugin_list, "What looks and writes.", {name}},
      {"output",
       SectionForm::single,
       "What the run itself writes.",
       {Parameter::integer("steps_every", "a row of steps.csv every so many steps").at_least(1).by_default(1),
        Parameter::number("checkpoint_interval", "s",
                          "simulated time between checkpoints; 0 writes one at the end only")
            .at_least(0.0)
            .by_default(0.0)}}};
}

}  // namespace

std::vector<Variant> shape_variants() {
  std::vector<Variant> shapes = primitive_variants(pose_parameters());
  shapes.push_back(
      {"compound",
       "Several shapes joined rigidly.",
       {Parameter::variants("parts", primitive_variants(pose_parameters()), "the parts, each with a pose")}});
  return shapes;
}

const std::vector<SceneSection>& scene_sections() {
  static const std::vector<SceneSection> sections = [] {
    std::vector<SceneSection> all = model_sections();
    for (SceneSection& part : machine_sections()) all.push_back(std::move(part));
    for (SceneSection& part : part_sections()) all.push_back(std::move(part));
    return all;
  }();
  return sections;
}

const SceneSection& scene_section(std::string_view name) {
  for (const SceneSection& section : scene_sections()) {
    if (section.name == name) return section;
  }
  throw std::logic_error{"core has no scene section '" + std::string{name} + "'"};
}

}  // namespace scree
