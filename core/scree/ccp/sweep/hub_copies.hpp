// HubCopies: a body that very many contacts touch, as several lighter ones, so that they need not wait for each other.
//
// The contacts of a phase of a sweep see S copies of a hub, each of 1/S of its mass: as many a chunk as there are lanes of a group
// that have it (grouping.hpp), so that one chunk with few of its contacts sees the hub itself. All start the
// phase with the hub's velocity and go their own ways; at its end the hub moves by the mean of what they did:
//
//     w <- w + 1/S sum_c (w_c - w)      which is M^-1 times the sum of the impulses
//
// For impulses p_c on the copies 1/2 |sum p_c|^2 / M <= S/2 sum |p_c|^2 / M: what goes downhill for the copies does so for the
// hub (mass splitting: Tonge, Benevolenski & Voroshilov 2012, ACM Trans. Graph. 31:105). With a heavy hub the copies are still
// heavy, and convergence is that of one body.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scree/ccp/sweep/sequence.hpp"
#include "scree/ccp/sweep/update.hpp"

namespace scree::sweep {

/// Keeps its memory between problems.
class HubCopies {
 public:
  /// For the hubs of `sequence`; copies are numbered from `first_copy` on. A chunk has up to `slots` copies of a hub.
  void start(const Sequence& sequence, std::size_t slots, std::uint32_t first_copy);
  /// The copy of hub `body` for slot `slot` of a chunk, which belongs to a phase. Chunk by chunk.
  std::uint32_t take(const Sequence& sequence, std::uint32_t body, std::uint32_t chunk, std::uint32_t phase,
                     std::size_t slot);
  /// When all are taken.
  void finish(std::size_t phases);

  [[nodiscard]] std::size_t size() const { return copies_.size(); }
  [[nodiscard]] bool is_copy(std::uint32_t index) const { return index >= first_copy_ && index - first_copy_ < size(); }
  /// The hub of copy k < size(), and how much lighter the copy is [1].
  [[nodiscard]] std::uint32_t hub(std::size_t k) const { return copies_[k].body; }
  [[nodiscard]] double weight(std::size_t k) const { return copies_[k].weight; }
  [[nodiscard]] double weight_of(std::uint32_t index) const {
    return is_copy(index) ? weight(index - first_copy_) : 1.0;
  }

  /// Before the phase: copies get the velocities of their hubs. After it: hubs move by the mean of their copies.
  void spread(std::size_t phase, std::span<Body> bodies) const;
  void collect(std::size_t phase, std::span<Body> bodies) const;

 private:
  struct Copy {
    std::uint32_t body = 0, phase = 0;
    double weight = 1.0;
  };
  /// Copies order_[first] .. order_[last - 1] of one hub in one phase.
  struct Run {
    std::uint32_t body = 0, first = 0, last = 0;
  };
  struct Taken {
    std::uint32_t chunk = Sequence::kNoHub, copy = 0;
  };

  std::uint32_t first_copy_ = 0;
  std::size_t slots_ = 0;
  std::vector<Taken> taken_;  ///< per hub and slot, of the last chunk
  std::vector<Copy> copies_;
  std::vector<std::uint32_t> order_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> first_run_;  ///< per phase, and the end
};

}  // namespace scree::sweep
