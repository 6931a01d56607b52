// A world far above its floor, with joints, for tests of dvi.
#pragma once

#include <memory>
#include <numbers>
#include <utility>

#include "dvi_world.hpp"
#include "scree/machine/joint_type.hpp"
#include "scree/machine/machine.hpp"

namespace scree::test {

inline constexpr double kHigh = 100.0;  // [m]

struct JointedWorld : World {
  using World::World;

  /// A body of the given mass [kg] and moments [kg m2]; returns its id.
  BodyId add_body(const Vec3& at, const Vec3& inertia, double mass = 1.0, const Quat& turned = {}) {
    const std::size_t i = bodies.add(bodies.id.size(), Motion::dynamic, at, 0.05, mass, inertia, {});
    bodies.orientation[i] = turned;
    return i;
  }

  /// A joint of `type` at a point and axis of the world, between bodies (or the world) as they stand.
  [[nodiscard]] Joint joint_at(const char* type, BodyId a, BodyId b, const Vec3& point,
                               const Vec3& axis = {0, 0, 1}) const {
    const Pose frame{point, rotation_between({0, 0, 1}, axis)};
    const auto end = [&](BodyId id) {
      if (id == kWorld) return JointEnd{kWorld, frame};
      return JointEnd{id, inverse(Pose{bodies.position[id], bodies.orientation[id]}) * frame};
    };
    return {.name = type, .type = find_joint_type(type), .a = end(a), .b = end(b)};
  }

  /// Takes the machine. Without `exact` the solver does nothing: all is left to the machine's own pass, which is enough
  /// where no stop and no limit of a motor acts.
  void join(MachineDescription description, bool exact = false) {
    machine = std::make_unique<Machine>(std::move(description));
    machine->start(bodies.view());
    host.joints = machine.get();
    host.tolerance = exact ? 1e-12 : 1e9;
  }

  [[nodiscard]] const MachineReport& report(std::size_t k) const { return machine->reports()[k]; }

  std::unique_ptr<Machine> machine;
};

/// A motor with a constant value.
[[nodiscard]] inline Motor motor(std::uint32_t joint, Coordinate along, Drive drive, double value) {
  return {.name = "motor", .joint = joint, .coordinate = along, .drive = drive, .value = TimeFunction{value}};
}

}  // namespace scree::test
