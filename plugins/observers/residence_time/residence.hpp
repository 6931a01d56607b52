// Residence times of one kind of bodies: the distribution and its numbers.
//
//     mean       tau     = sum w t / sum w                 w: one or the mass of a body
//     variance   sigma^2 = sum w (t - tau)^2 / sum w       times n / (n - 1) by number
//     tanks      N       = tau^2 / sigma^2                 as many ideal mixers in a row have this variance
//     E(t)       share of what left per unit of its residence time, F(t) its integral
//     tanks in series: E(t) = t^(N-1) exp(-t / s) / (Gamma(N) s^N), s = tau / N      (Levenspiel, Chemical Reaction
//                                                                                    Engineering, 3rd ed., ch. 14)
#pragma once

#include <span>
#include <vector>

#include "analysis/statistics.hpp"

namespace scree {

/// Numbers of a distribution of residence times.
struct Residence {
  std::size_t count = 0;
  double weight = 0.0;                     ///< sum of the weights
  double mean = 0.0;                       ///< tau [s]
  double error = 0.0;                      ///< standard error of the mean, for independent bodies [s]
  double variance = 0.0;                   ///< sigma^2 [s2]
  double tanks = 0.0;                      ///< N [1]; infinite for plug flow
  double t10 = 0.0, t50 = 0.0, t90 = 0.0;  ///< times that 10, 50 and 90 % stay less than [s]
};

/// Of times [s] with weights. NaN where there are too few.
[[nodiscard]] Residence residence_of(std::span<const Weighted> times);

/// Share of the weight per bin and unit of time [1/s], for bins between ascending `edges` [s].
[[nodiscard]] std::vector<double> density_of(std::span<const Weighted> times, std::span<const double> edges);

/// E(t) of N equal tanks in series with the mean `mean` [s]; N >= 1 need not be whole [1/s].
[[nodiscard]] double tanks_in_series(double t, double mean, double tanks);

}  // namespace scree
