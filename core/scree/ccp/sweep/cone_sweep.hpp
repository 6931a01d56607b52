// ConeSweep: contacts that resist rolling, as blocks of 5 or 6 rows, four at a time (cone_group.hpp).
//
// Their rows are those of a contact: three along the axes of its frame, opposite for the two bodies, and two or three that turn the
// bodies against each other. Cones with other rows are left to who goes block by block.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/ccp/sweep/block_step.hpp"
#include "scree/ccp/sweep/cone_group.hpp"
#include "scree/ccp/sweep/contact_sweep.hpp"

namespace scree::sweep {

/// Keeps its memory between problems.
class ConeSweep {
 public:
  /// Takes the blocks that it can; the numbers of the others are put into `others`. `contacts`, whose bodies are moved, and
  /// `steps` are bound to the same problem.
  void bind(const CcpProblem& problem, ContactSweep& contacts, const BlockSteps& steps,
            std::vector<std::uint32_t>& others);

  /// Every cone once, in order or backwards. All spans have a number for each row of the blocks; `compliance` may be empty.
  void sweep(bool backward, const BlockSteps& steps, std::span<const double> r, std::span<const double> compliance,
             std::span<double> g);

 private:
  void put(const CcpProblem& problem, const BlockSteps& steps, std::size_t k, ConeGroup& group, int lane) const;

  ContactSweep* contacts_ = nullptr;
  std::vector<ConeGroup> groups_;
};

}  // namespace scree::sweep
