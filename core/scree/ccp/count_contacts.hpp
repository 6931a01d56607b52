// count_contacts: how many contacts a contact problem has, whatever their friction.
#pragma once

#include <algorithm>
#include <cstddef>

#include "scree/ccp/problem.hpp"

namespace scree {

/// The contacts of `problem`: those of three rows in front, and the cones among its blocks, which also resist rolling or
/// spinning. Joints, limits and motors are none.
[[nodiscard]] inline std::size_t count_contacts(const CcpProblem& problem) {
  const auto is_contact = [](const CcpBlock& block) { return block.kind == CcpKind::cone; };
  return problem.contacts.size() + static_cast<std::size_t>(std::ranges::count_if(problem.blocks, is_contact));
}

}  // namespace scree
