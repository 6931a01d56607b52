// Constant rate of a flow over a window of time, with a confidence interval that holds for grains that come in bursts.
//
// What passes in neighbouring intervals is not independent (arches form and break), and what has passed is a random walk, so
// that the error of a line through it means nothing. The window is therefore divided into blocks, long against the bursts;
// their rates are taken as independent (the method of batch means), and Student's t does the rest. Blocks end where
// intervals do, as near to equal lengths as that allows: what passed within an interval is not known to belong to one part
// of it. A rate counts by the length of its block, with which its variance falls.
#pragma once

#include <span>

#include "analysis/statistics.hpp"

namespace scree {

/// A constant rate and what speaks against it.
struct FlowRate {
  Estimate rate;                ///< [amount/s]; error: half the confidence interval
  Estimate drift;               ///< change of the rate [amount/s2] with its standard error
  std::size_t blocks = 0;       ///< that the rate rests on
  double from = 0.0, to = 0.0;  ///< window that was used [s]
};

/// `begin` and `end` of intervals [s], ascending, each beginning where the last ended, and what passed in each [amount].
/// Uses all that lie within [from, to], and fewer blocks where there are fewer intervals.
[[nodiscard]] FlowRate constant_rate(std::span<const double> begin, std::span<const double> end,
                                     std::span<const double> amount, double from, double to, std::size_t blocks,
                                     double confidence);

}  // namespace scree
