// The order of contacts inside short windows, such that neighbours in the order
// rarely share a body.
//
// A contact whose body was written by the contact before has to wait for it: a
// hundred cycles of latency that a processor can otherwise fill with the next
// contacts. Windows are short, so that memory is still walked through in order.
#pragma once

#include <cstdint>
#include <vector>

#include "scree/ccp/problem.hpp"

namespace scree::pgs {

/// Contacts of a window; a divisor of Colouring::kChunkLength.
inline constexpr std::size_t kWindow = 64;

/// Fills `order` with all contacts, window by window.
void schedule(const CcpProblem& problem, std::vector<std::uint32_t>& order);

}  // namespace scree::pgs
