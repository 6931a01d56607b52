// MachineRow: one row that a machine may add to the contact problem, and its value and Jacobian at given poses.
//
// All rows are lengths: those of angles are multiplied by L, the smaller radius of the joint's bodies (ADR 0008), so that
// an impulse g of the row is a moment impulse L g.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/machine/joint_geometry.hpp"

namespace scree {

/// The joints of a scene and what goes with them.
struct MachineDescription {
  std::vector<Joint> joints;
  std::vector<Motor> motors = {};
  std::vector<Coupling> couplings = {};
};

/// What a machine remembers of its joints between steps.
struct JointState {
  double angle = 0.0;                        ///< of the coordinate rotation, with its turns [rad]
  std::array<double, kCoordinates> start{};  ///< coordinates at the start: what couplings count from [rad], [m]
  bool gone = false;                         ///< broken, or one of its bodies has left
};

enum class RowRole : std::uint8_t { equation, spring, stop, motor, coupling };

/// Rows that make one block of the problem.
struct RowGroup {
  RowRole role = RowRole::equation;
  std::uint32_t owner = 0;  ///< joint; motor or coupling by its own number
  Coordinate coordinate = Coordinate::rotation;
  std::uint32_t first_slot = 0;  ///< of all rows that the machine can have
  std::uint8_t rows = 1;
};

/// A row: what it takes to the rate of its value.
struct MachineRow {
  /// Bodies of the machine by number; -1 for the world.
  int a = -1, b = -1;
  CcpRow row;
};

/// The angle at t = 0 that a motor imposes on a joint [rad]; zero where none does.
[[nodiscard]] double starting_angle(const MachineDescription& machine, std::uint32_t joint);

/// All rows that a machine may have, joint by joint, then motors, then couplings.
[[nodiscard]] std::vector<RowGroup> row_groups(const MachineDescription& machine);

/// Where the joints are: for values of rows.
struct MachinePlacement {
  std::span<const JointPlacement> joints;
  std::span<const JointState> states;
  double time = 0.0;  ///< for motors [s]
};

/// A coordinate of a joint with its turns [rad], [m].
[[nodiscard]] double coordinate_of(const MachineDescription& machine, const MachinePlacement& at, std::uint32_t joint,
                                   Coordinate c);

/// Value of row k of a group, `length` times the natural one [m]: of an equation or coupling its error; of a spring the way
/// from its rest; of stops what is left; of a motor the way to where it shall be (zero for those that impose no position).
[[nodiscard]] double row_value(const MachineDescription& machine, const RowGroup& group, std::size_t k,
                               const MachinePlacement& at, double length);

/// Jacobian of row k of a group that belongs to one joint. Couplings: see coupling_row().
[[nodiscard]] CcpRow row_jacobian(const MachineDescription& machine, const RowGroup& group, std::size_t k,
                                  const MachinePlacement& at, double length);

/// The joint that a group acts on; of a coupling the first.
[[nodiscard]] std::uint32_t joint_of(const MachineDescription& machine, const RowGroup& group);

/// True when the row is an angle, which is multiplied by L.
[[nodiscard]] bool is_angular(const MachineDescription& machine, const RowGroup& group, std::size_t k);

}  // namespace scree
