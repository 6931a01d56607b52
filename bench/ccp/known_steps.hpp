// Recorded contact problems of consecutive steps, with their solutions, and what one step's impulses are at the contacts of the next.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scree/ccp/ccp_file.hpp"

namespace scree::bench {

constexpr double kExact = 1e-7;  ///< residual of what counts as the solution [m/s]
constexpr int kMostSweeps = 100000;

/// A problem without blocks, as `scree run --record-ccp` wrote it.
struct KnownStep {
  CcpRecord record;
  std::vector<double> solution;  ///< to 1e-7 m/s [N s]
};

/// Reads and solves. A file does not say which body is which: the masses of those that move must all differ, and tell. @throws Error
/// (io), std::runtime_error for blocks, equal masses and a problem that `asgs` does not solve.
[[nodiscard]] KnownStep read_known_step(const std::string& file);

/// How an impulse goes from one step to the next: as a vector of the world, or turned with its contact's normal.
enum class Carried { in_world, with_contact };

/// Impulses `gamma` at the contacts of `from`, brought to those of `to`; zero where the contact was not there. Of two contacts of the
/// same bodies the one with the nearest normal counts.
[[nodiscard]] std::vector<double> carry(const CcpRecord& from, std::span<const double> gamma, const CcpRecord& to,
                                        Carried how);

}  // namespace scree::bench
