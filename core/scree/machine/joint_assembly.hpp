// Joint assembly: bodies of a machine moved until its joints are together, and equations that repeat others found.
//
// Newton's method on the equations Psi(q) = 0, each step the smallest in the norm of the mass matrix,
//
//     dq = -M^-1 D (D^T M^-1 D)^+ Psi,
//
// so that heavy bodies move least; bodies that forces do not move stay (Haug 1989, section 4.4). Turns of a step are
// limited to half a radian.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scree/machine/machine_row.hpp"
#include "scree/model/body_store.hpp"

namespace scree {

/// What an assembly found.
struct AssemblyReport {
  bool together = true;           ///< to `tolerance`
  double tolerance = 0.0;         ///< [m]
  double error_before = 0.0;      ///< greatest violation of an equation [m]; of angles times L
  double error = 0.0;             ///< the same after it [m]
  std::uint32_t worst_joint = 0;  ///< with the greatest violation, at the end or, when nothing moved, at the beginning
  double greatest_move = 0.0;     ///< of a centre of mass [m]
  std::size_t moved_body = 0;     ///< which one, by place in `bodies`
  std::vector<std::uint32_t> flipped;                ///< joints whose axes ended up opposed
  std::size_t redundant_equations = 0;               ///< that follow from others
  std::vector<std::uint32_t> redundant;              ///< joints that they belong to
  std::optional<std::uint32_t> contradicting_motor;  ///< without a limit, imposes what is determined already
};

/// Motors without a limit that impose a position count as equations at t = 0. Moves the poses of `bodies`, whose places are their ids. When `move` is false nothing moves and the errors are reported.
[[nodiscard]] AssemblyReport assemble(const MachineDescription& machine, std::span<NewBody> bodies, bool move);

}  // namespace scree
