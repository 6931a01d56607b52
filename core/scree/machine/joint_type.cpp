#include "scree/machine/joint_type.hpp"

#include <algorithm>

namespace scree {

std::span<const JointType> joint_types() {
  using enum JointEquation;
  static const std::vector<JointType> types = {
      {"fixed", "b does not move against a.", {shift_x, shift_y, shift_z, turn_x, turn_y, turn_z}},
      {"revolute", "A hinge: b turns about the axis.", {shift_x, shift_y, shift_z, tilt_x, tilt_y}, true},
      {"prismatic", "A slide: b moves along the axis.", {shift_x, shift_y, turn_x, turn_y, turn_z}, false, true},
      {"cylindrical", "b turns about the axis and moves along it.", {shift_x, shift_y, tilt_x, tilt_y}, true, true},
      {"spherical", "A ball joint: b turns about the point.", {shift_x, shift_y, shift_z}},
      {"universal",
       "Two crossed arms: the second, of b, stays square to the first, of a.",
       {shift_x, shift_y, shift_z, cross}},
      {"planar", "b slides on the plane square to the axis and turns in it.", {shift_z, tilt_x, tilt_y}, true},
      {"point_on_line", "The point of b moves along the axis, and b turns freely.", {shift_x, shift_y}, false, true},
      {"distance", "A rod without mass: the two points keep their distance.", {JointEquation::distance}},
      {"spring_damper",
       "Nothing but what acts along the line between two points: a spring, a damper, stops, a motor.",
       {},
       false,
       false,
       true},
  };
  return types;
}

const JointType* find_joint_type(std::string_view name) {
  const auto types = joint_types();
  const auto at = std::ranges::find(types, name, &JointType::name);
  return at == types.end() ? nullptr : &*at;
}

}  // namespace scree
