// Colouring: an order of the contacts in which threads may work side by side.
//
// The chunks of a Sequence get colours such that chunks of one colour share no
// movable body but hubs, of which each has its copies (hub_copies.hpp). A sweep
// goes colour by colour; inside a colour the order of chunks cannot show, inside
// a chunk contacts go in order. Chunks that fit no colour come last, one after
// the other.
#pragma once

#include <cstdint>
#include <vector>

#include "scree/ccp/problem.hpp"
#include "scree/ccp/sweep/sequence.hpp"

namespace scree::sweep {

/// Greedy colouring of chunks of contacts. Keeps its memory between calls.
class Colouring {
 public:
  /// Contacts of a chunk: enough to be worth handing to a thread, few enough to
  /// make several chunks a colour on 10 000 contacts.
  static constexpr std::size_t kChunkLength = 256;
  static constexpr std::size_t kMaxColours = 64;

  void build(const CcpProblem& problem, const Sequence& sequence);

  /// Chunks in order of colour.
  [[nodiscard]] const std::vector<std::uint32_t>& chunks() const { return chunks_; }
  /// Chunks of colour c: chunks()[first()[c]] .. chunks()[first()[c + 1]]; those
  /// that fit none follow from first().back() on.
  [[nodiscard]] const std::vector<std::uint32_t>& first() const { return first_; }

 private:
  std::vector<std::uint64_t> colours_of_body_;  ///< bit c: a chunk of colour c touches it
  std::vector<std::uint32_t> colour_;           ///< per chunk
  std::vector<std::uint32_t> chunks_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> cursor_;
};

}  // namespace scree::sweep
