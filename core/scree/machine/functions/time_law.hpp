// TimeLaw: the mathematics behind a TimeFunction. Private to core/scree/machine/functions.
#pragma once

#include <memory>

namespace scree {

class Options;

/// A function of time in the unit of its setting. Never changed once made: several threads may ask it at once.
class TimeLaw {
 public:
  virtual ~TimeLaw() = default;
  [[nodiscard]] virtual double value(double t) const = 0;
  /// By time [1/s]; from the right where there is a kink.
  [[nodiscard]] virtual double derivative(double t) const = 0;
  /// Over time from `a` to `b` [s].
  [[nodiscard]] virtual double integral(double a, double b) const = 0;
  /// True when integral() is exact over any span.
  [[nodiscard]] virtual bool has_closed_integral() const { return true; }
};

/// The laws with a formula: constant, ramp, smooth_step, sine.
[[nodiscard]] std::unique_ptr<const TimeLaw> make_formula_law(const Options& options);

/// A law through points. @throws Error (usage, io) when they are no function of time.
[[nodiscard]] std::unique_ptr<const TimeLaw> make_table_law(const Options& options);

/// What muParser computes. @throws Error (usage) at the expression, with the place in it.
[[nodiscard]] std::unique_ptr<const TimeLaw> make_expression_law(const Options& options);

}  // namespace scree
