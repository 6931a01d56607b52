#include "scree/machine/machine_row.hpp"

#include <cmath>

namespace scree {
namespace {

bool has_stop(const CoordinateLaw& law) { return std::isfinite(law.lower) || std::isfinite(law.upper); }

/// Row k of the stops of `law` is the lower one.
bool is_lower(const CoordinateLaw& law, std::size_t k) { return k == 0 && std::isfinite(law.lower); }

std::uint8_t stops_of(const CoordinateLaw& law) {
  return static_cast<std::uint8_t>(int{std::isfinite(law.lower)} + int{std::isfinite(law.upper)});
}

}  // namespace

double starting_angle(const MachineDescription& machine, std::uint32_t joint) {
  for (const Motor& motor : machine.motors) {
    const bool imposes = motor.drive == Drive::position && motor.coordinate == Coordinate::rotation;
    if (motor.joint == joint && imposes) return motor.value.value(0.0);
  }
  return 0.0;
}

std::vector<RowGroup> row_groups(const MachineDescription& machine) {
  std::vector<RowGroup> groups;
  std::uint32_t slot = 0;
  const auto add = [&](RowRole role, std::size_t owner, Coordinate c, std::size_t rows) {
    groups.push_back({role, static_cast<std::uint32_t>(owner), c, slot, static_cast<std::uint8_t>(rows)});
    slot += static_cast<std::uint32_t>(rows);
  };
  for (std::size_t j = 0; j < machine.joints.size(); ++j) {
    const Joint& joint = machine.joints[j];
    if (!joint.type->equations.empty()) add(RowRole::equation, j, {}, joint.type->equations.size());
    for (const Coordinate c : {Coordinate::rotation, Coordinate::translation}) {
      const CoordinateLaw& law = joint.along(c);
      if (law.spring.acts()) add(RowRole::spring, j, c, 1);
      if (has_stop(law)) add(RowRole::stop, j, c, stops_of(law));
    }
  }
  for (std::size_t m = 0; m < machine.motors.size(); ++m) add(RowRole::motor, m, machine.motors[m].coordinate, 1);
  for (std::size_t c = 0; c < machine.couplings.size(); ++c) add(RowRole::coupling, c, {}, 1);
  return groups;
}

double coordinate_of(const MachineDescription& machine, const MachinePlacement& at, std::uint32_t joint, Coordinate c) {
  const double value = coordinate_value(*machine.joints[joint].type, c, at.joints[joint]);
  return c == Coordinate::rotation ? nearest_turn(value, at.states[joint].angle) : value;
}

std::uint32_t joint_of(const MachineDescription& machine, const RowGroup& group) {
  if (group.role == RowRole::motor) return machine.motors[group.owner].joint;
  if (group.role == RowRole::coupling) return machine.couplings[group.owner].first;
  return group.owner;
}

bool is_angular(const MachineDescription& machine, const RowGroup& group, std::size_t k) {
  if (group.role == RowRole::equation) return is_angular(machine.joints[group.owner].type->equations[k]);
  if (group.role == RowRole::coupling) return machine.couplings[group.owner].of_second == Coordinate::rotation;
  return group.coordinate == Coordinate::rotation;
}

double row_value(const MachineDescription& machine, const RowGroup& group, std::size_t k, const MachinePlacement& at,
                 double length) {
  const std::uint32_t j = joint_of(machine, group);
  const Joint& joint = machine.joints[j];
  if (group.role == RowRole::equation) {
    return equation_value(joint.type->equations[k], at.joints[j], length, joint.distance);
  }
  const double scale = is_angular(machine, group, k) ? length : 1.0;
  if (group.role == RowRole::coupling) {
    const Coupling& c = machine.couplings[group.owner];
    const auto way = [&](std::uint32_t of, Coordinate along) {
      return coordinate_of(machine, at, of, along) - at.states[of].start[static_cast<std::size_t>(along)];
    };
    return scale * (way(c.second, c.of_second) - c.ratio * way(c.first, c.of_first));
  }
  const double x = coordinate_of(machine, at, j, group.coordinate);
  const CoordinateLaw& law = joint.along(group.coordinate);
  switch (group.role) {
    case RowRole::spring:
      return scale * (x - law.rest);
    case RowRole::stop:
      return scale * (is_lower(law, k) ? x - law.lower : law.upper - x);
    default:
      break;
  }
  const Motor& motor = machine.motors[group.owner];
  return motor.drive == Drive::position ? scale * (x - motor.value.value(at.time)) : 0.0;
}

CcpRow row_jacobian(const MachineDescription& machine, const RowGroup& group, std::size_t k, const MachinePlacement& at,
                    double length) {
  const std::uint32_t j = joint_of(machine, group);
  const Joint& joint = machine.joints[j];
  if (group.role == RowRole::equation) return equation_row(joint.type->equations[k], at.joints[j], length);
  const double scale = is_angular(machine, group, k) ? length : 1.0;
  const bool towards_lower = group.role == RowRole::stop && !is_lower(joint.along(group.coordinate), k);
  return scaled(coordinate_row(*joint.type, group.coordinate, at.joints[j]), towards_lower ? -scale : scale);
}

}  // namespace scree
