// JointType: which equations a joint has, as data.
//
// Glossary: frames A and B on the bodies a and b, with origins p and axes x, y, z; d = p_B - p_A; q, the orientation of B
// in A; L, a length that makes equations of angles lengths (ADR 0008).
//
//     shift_k    e_k . d                    e_k the k-th axis of A
//     turn_k     2 L sign(q_w) q_k          the components of the rotation from A to B
//     tilt_k     L z_B . e_k                k = x, y: z_B along z_A
//     cross      L y_B . x_A                the two arms of a universal joint
//     distance   |d| - l
//
// Each vanishes when the joint is together (Haug 1989, "Computer Aided Kinematics and Dynamics of Mechanical Systems",
// chapter 9: products of the axes of two frames).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scree/machine/joint.hpp"

namespace scree {

enum class JointEquation : std::uint8_t {
  shift_x,
  shift_y,
  shift_z,
  turn_x,
  turn_y,
  turn_z,
  tilt_x,
  tilt_y,
  cross,
  distance
};

/// True for equations of angles, which are multiplied by a length.
[[nodiscard]] constexpr bool is_angular(JointEquation e) {
  return e >= JointEquation::turn_x && e != JointEquation::distance;
}

struct JointType {
  std::string_view name;
  std::string_view help;
  std::vector<JointEquation> equations;
  bool turns = false;      ///< has the coordinate rotation
  bool slides = false;     ///< has the coordinate translation, along z of A
  bool stretches = false;  ///< has the coordinate translation, which is |d|

  [[nodiscard]] bool has(Coordinate c) const { return c == Coordinate::rotation ? turns : slides || stretches; }
};

/// All types, in the order in which documentation shows them.
[[nodiscard]] std::span<const JointType> joint_types();

/// A type by name, or null.
[[nodiscard]] const JointType* find_joint_type(std::string_view name);

}  // namespace scree
