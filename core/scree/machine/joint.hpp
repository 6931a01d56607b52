// Joint: what ties two bodies of a machine together.
//
// A joint has a frame on each of its bodies, and equations between the frames (joint_type.hpp). What its equations leave
// free, its coordinates, may have a spring, stops and a motor:
//
//     rotation     angle of b about the z axis of frame a [rad], counted over any number of turns
//     translation  way of b along the z axis of frame a, or the distance of the two origins [m]
//
// The frames of a scene are on bodies as written; here they are in the body frame (centre of mass, principal axes).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "scree/machine/functions/time_function.hpp"
#include "scree/math/pose.hpp"
#include "scree/model/body.hpp"

namespace scree {

struct JointType;

/// In the place of a body: the world.
inline constexpr BodyId kWorld = std::numeric_limits<BodyId>::max();

enum class Coordinate : std::uint8_t { rotation, translation };
inline constexpr std::size_t kCoordinates = 2;

/// One side of a joint.
struct JointEnd {
  BodyId body = kWorld;
  Pose frame;  ///< in the body frame [m]; in the world for kWorld
};

/// A stiffness and a damping that act together, both integrated implicitly.
struct SpringLaw {
  double stiffness = 0.0;  ///< [N/m], or [N m/rad]
  double damping = 0.0;    ///< [N s/m], or [N m s/rad]

  [[nodiscard]] bool acts() const { return stiffness > 0.0 || damping > 0.0; }
};

/// What acts along one coordinate of a joint.
struct CoordinateLaw {
  SpringLaw spring;
  double rest = 0.0;     ///< where the spring is slack [m], [rad]
  double preload = 0.0;  ///< force at rest, towards growing coordinates; needs a spring [N], [N m]
  double lower = -std::numeric_limits<double>::infinity();  ///< stop [m], [rad]
  double upper = std::numeric_limits<double>::infinity();   ///< stop, >= lower [m], [rad]
  double stop_restitution = 0.0;                            ///< of the stops [1]
};

/// A joint of a scene.
struct Joint {
  std::string name;
  const JointType* type = nullptr;
  JointEnd a = {}, b = {};
  double distance = 0.0;  ///< of a `distance` joint [m]
  /// Of the equations: rigid without. Stiffness [N/m] and damping of shifts; [N m/rad] and so on of tilts.
  SpringLaw shift = {}, tilt = {};
  std::array<CoordinateLaw, kCoordinates> law = {};                  ///< by Coordinate
  double breaking_force = std::numeric_limits<double>::infinity();   ///< [N]
  double breaking_torque = std::numeric_limits<double>::infinity();  ///< [N m]

  [[nodiscard]] const CoordinateLaw& along(Coordinate c) const { return law[static_cast<std::size_t>(c)]; }
};

/// What a motor imposes.
enum class Drive : std::uint8_t {
  position,  ///< the coordinate itself, angle [rad] or way [m]
  speed,     ///< its rate [rad/s], [m/s]
  effort     ///< torque [N m] or force [N]
};

/// A motor on a coordinate of a joint.
struct Motor {
  std::string name;
  std::uint32_t joint = 0;
  Coordinate coordinate = Coordinate::rotation;
  Drive drive = Drive::speed;
  TimeFunction value = TimeFunction{};                     ///< [rad], [rad/s], [N m]; [m], [m/s], [N]
  double limit = std::numeric_limits<double>::infinity();  ///< greatest torque [N m] or force [N]
};

/// Two coordinates in a fixed ratio: gears, rack and pinion, screws. x2 - x2(start) = ratio (x1 - x1(start)).
struct Coupling {
  std::string name;
  std::uint32_t first = 0, second = 0;  ///< joints
  Coordinate of_first = Coordinate::rotation, of_second = Coordinate::rotation;
  double ratio = 1.0;  ///< [1], or [m/rad]
};

}  // namespace scree
