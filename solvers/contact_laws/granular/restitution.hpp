// Restitution of a spring and a dashpot: which damping ratio zeta gives which coefficient of restitution e.
//
//     m x'' + 2 zeta w0 m x' + w0^2 m x = 0,     x overlap, w0 = sqrt(k / m), zeta = C / (2 sqrt(k m))
//
// Contact until the gap is zero again (tension at the end): e = exp(-pi zeta / sqrt(1 - zeta^2)), Tsuji, Tanaka, Ishida,
// Powder Technology 71 (1992) 239. Contact until the force is zero (no tension), with zeta = cos(theta):
// e = exp(-2 theta cot(theta)), or, with zeta = cosh(u) > 1, exp(-2 u coth(u)): Schwager and Poeschel, Granular Matter 9
// (2007) 465.
//
// Both hold for Hertz' spring k x^(3/2) with the dashpot sqrt(5 k m) zeta x^(1/4): Antypov and Elliott, EPL 94 (2011) 50004,
// map it onto the linear one, velocities and the sign of the force included.
#pragma once

#include <limits>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/config/parameter.hpp"

namespace scree::granular {

/// When an impact is over.
enum class EndOfContact {
  no_tension,  ///< when the force of spring and dashpot is zero
  gap          ///< when the gap is zero again; the dashpot pulls before
};

/// e [1] of the damping ratio zeta >= 0 [1].
[[nodiscard]] double restitution(double zeta, EndOfContact end);
/// zeta [1] of 0 < e <= 1 [1], to rounding; the inverse of restitution().
[[nodiscard]] double damping_ratio(double e, EndOfContact end);

/// The settings `end_of_contact`, `friction_in_tension` and `least_restitution`, for a law's parameters().
[[nodiscard]] std::vector<Parameter> restitution_parameters();

/// The same, read.
struct RestitutionOptions {
  explicit RestitutionOptions(const Options& options);
  EndOfContact end = EndOfContact::no_tension;
  bool friction_in_tension = true;
  double least = 0.05;  ///< restitution; a smaller one takes its value [1]

  /// The least force of spring and dashpot, > 0 pushes [N].
  [[nodiscard]] double least_force() const {
    return end == EndOfContact::gap ? -std::numeric_limits<double>::infinity() : 0.0;
  }
  /// The force F of spring and dashpot loads the contact with max(F, this F) for friction [1].
  [[nodiscard]] double tail() const { return end == EndOfContact::gap && friction_in_tension ? -1.0 : 0.0; }

  [[nodiscard]] double ratio_of(double e) const { return damping_ratio(e > least ? e : least, end); }
};

}  // namespace scree::granular
