// ContactPartition: lets several threads add impulses to bodies at once, with
// the same bits for any number of them.
//
// The units, contacts and then blocks, are cut into runs of fixed length. A body
// touched by r runs gets r slots, one a run, in the order of the runs; the body's
// sum is that of its slots in this order. Runs never share a slot, so they need
// no locks, and who executes a run does not show in the result. Immovable bodies
// get one slot a run that nobody reads. With bodies in spatial order few bodies
// are shared.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/ccp/problem.hpp"

namespace scree {

/// Where a unit puts the impulses on its bodies.
struct SlotPair {
  std::uint32_t a = 0;  ///< index into an array of slot_count() sums
  std::uint32_t b = 0;
};

/// The runs of a problem's units and the slots of its bodies; empty for a problem with a matrix. Keeps its
/// memory between calls.
class ContactPartition {
 public:
  /// Units of a run: long, so that few bodies are shared; short enough for
  /// some runs a thread on 10 000 contacts.
  static constexpr std::size_t kRunLength = 4096;

  void build(const CcpProblem& problem);

  [[nodiscard]] std::span<const SlotPair> slots() const { return slots_; }
  [[nodiscard]] std::size_t slot_count() const { return slot_count_; }
  /// Slots of body k: first_slot()[k] .. first_slot()[k + 1].
  [[nodiscard]] std::span<const std::uint32_t> first_slot() const { return first_slot_; }

 private:
  std::size_t slot_count_ = 0;
  std::vector<SlotPair> slots_;
  std::vector<std::uint32_t> first_slot_;
  std::vector<std::uint32_t> last_run_;
  std::vector<std::uint32_t> current_slot_;
};

}  // namespace scree
