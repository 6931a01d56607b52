// What a scene may say about joints, motors and couplings.
#include <string>

#include "scree/machine/joint_type.hpp"
#include "scree/simulation/scene_machine.hpp"

namespace scree {
namespace {

std::vector<Parameter> frame_parameters(const char* position_help) {
  return {
      Parameter::vector("position", "m", position_help).by_default(Vec3{}),
      Parameter::vector("axis", "1", "z axis of the frame").by_default(Vec3{0, 0, 1}),
      Parameter::vector("reference", "1", "what its x axis points to, as far as it is square to `axis`").optional()};
}

/// What acts along a coordinate whose unit is `way`, with efforts in `effort`.
Parameter law_parameter(const char* name, const std::string& way, const std::string& effort, const char* help) {
  const bool angle = way == "rad";
  return Parameter::table(
             name,
             {Parameter::number("stiffness", angle ? "N m/rad" : "N/m", "of a spring").at_least(0.0).by_default(0.0),
              Parameter::number("damping", angle ? "N m s/rad" : "N s/m", "of a damper").at_least(0.0).by_default(0.0),
              Parameter::number("rest", way, "where the spring is slack").by_default(0.0),
              Parameter::number("preload", effort, "of the spring at rest, towards greater values").by_default(0.0),
              Parameter::number("lower", way, "stop").optional(), Parameter::number("upper", way, "stop").optional(),
              Parameter::number("restitution", "1", "of the stops").at_least(0.0).at_most(1.0).by_default(0.0)},
             help)
      .optional();
}

std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for (const JointType& type : joint_types()) names.emplace_back(type.name);
  return names;
}

std::vector<Parameter> joint_parameters() {
  return {
      Parameter::text("name", "by which motors, couplings, messages and joints.csv refer to it"),
      Parameter::choice("type", type_names(), "what it leaves free"),
      Parameter::texts("between", "its two bodies a and b: 'BODY', 'BODY.FRAME' of its frames, or 'world'")
          .with_count(2),
      Parameter::vector("position", "m", "of the joint in the world, where the bodies stand in the scene").optional(),
      Parameter::vector("position_b", "m", "of its point on b, where that is another one (distance, spring_damper)")
          .optional(),
      Parameter::vector("axis", "1", "its axis in the world: z of both frames").by_default(Vec3{0, 0, 1}),
      Parameter::vector("reference", "1", "x of both frames, as far as it is square to `axis`: where angles count from")
          .optional(),
      Parameter::number("distance", "m", "of a distance joint; that of the points in the scene when left out")
          .above(0.0)
          .optional(),
      Parameter::number("compliance", "m/N", "of its shifts, the inverse of a stiffness; 0 is rigid")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("damping", "N s/m", "of compliant shifts").at_least(0.0).by_default(0.0),
      Parameter::number("angular_compliance", "rad/(N m)", "of its tilts, the inverse of a stiffness; 0 is rigid")
          .at_least(0.0)
          .by_default(0.0),
      Parameter::number("angular_damping", "N m s/rad", "of compliant tilts").at_least(0.0).by_default(0.0),
      law_parameter("rotation", "rad", "N m", "spring, damper and stops of the angle of b about the axis"),
      law_parameter("translation", "m", "N", "spring, damper and stops of the way of b along the axis"),
      Parameter::number("breaking_force", "N", "the joint breaks above it").above(0.0).optional(),
      Parameter::number("breaking_torque", "N m", "the joint breaks above it").above(0.0).optional(),
      Parameter::boolean("collide", "the two bodies touch each other nevertheless").by_default(false)};
}

std::vector<Parameter> motor_parameters() {
  const auto one = [](const char* name, const char* unit, const char* help) {
    return TimeFunction::parameter(name, unit, help).optional();
  };
  return {
      Parameter::text("name", "by which messages and joints.csv refer to it"),
      Parameter::text("joint", "name of the joint that it drives"),
      one("angle", "rad", "imposes the angle of b about the axis"),
      one("angular_speed", "rad/s", "imposes the speed of b about the axis"),
      one("torque", "N m", "turns b about the axis"),
      one("position", "m", "imposes the way of b along the axis"),
      one("speed", "m/s", "imposes the speed of b along the axis"),
      one("force", "N", "pushes b along the axis"),
      Parameter::number("torque_limit", "N m", "greatest torque; without bound when left out").above(0.0).optional(),
      Parameter::number("force_limit", "N", "greatest force; without bound when left out").above(0.0).optional()};
}

std::vector<Parameter> coupling_parameters() {
  return {Parameter::text("name", "by which messages and joints.csv refer to it"),
          Parameter::texts("joints", "names of the two joints; one name twice for a screw").with_count(2),
          Parameter::texts("along", "'rotation' or 'translation' of each; what the joint has, when left out")
              .with_count(2)
              .optional(),
          Parameter::number("ratio", "any", "way of the second joint for one of the first: 1, m/rad or rad/m")};
}

}  // namespace

Parameter frames_parameter() {
  std::vector<Parameter> members{Parameter::text("name", "by which joints refer to it: 'BODY.NAME'")};
  for (Parameter& p : frame_parameters("of its origin, where the shape's origin is zero"))
    members.push_back(std::move(p));
  return Parameter::tables("frames", std::move(members), "frames fixed on the body, for joints").optional();
}

std::vector<SceneSection> machine_sections() {
  return {{"joint", SectionForm::list, "Ties two bodies, or a body and the world.", joint_parameters()},
          {"motor", SectionForm::list,
           "Drives a joint; give one of angle, angular_speed, torque, position, speed, force.", motor_parameters()},
          {"coupling", SectionForm::list,
           "Two joints in a fixed ratio: gears, rack and pinion, screws. They count from where they start.",
           coupling_parameters()}};
}

}  // namespace scree
