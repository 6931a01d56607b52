// TimeFunction: a number that changes with time as a scene describes it, for motors and prescribed motions.
//
//     speed = "3 rpm"                                                                  # constant
//     speed = { type = "ramp", from = 0.0, to = "3 rpm", start = "1 s", duration = "2 s" }
//     by = { type = "sine", amplitude = "2 mm", frequency = "50 Hz" }
//     by = { type = "table", times = [0.0, 1.0, 3.0], values = [0.0, 0.1, 0.1], interpolation = "monotone_cubic" }
//     by = { type = "expression", expression = "0.1 * sin(2*pi*5*t) * exp(-t)" }
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scree/base/error.hpp"
#include "scree/config/parameter.hpp"

namespace scree {

class Options;
class TimeLaw;

/// A function of time in one unit, that of its setting. A value type; copies are cheap, and several threads may ask one at
/// once. Wherever a value is no finite number: @throws Error (usage) at the place in the scene, with the time.
class TimeFunction {
 public:
  /// The parameter of a setting that may be a plain quantity of `unit`, or a function of time with values of it.
  static Parameter parameter(std::string name, const std::string& unit, std::string help);
  /// The alternatives of such a setting.
  static std::vector<Variant> variants(const std::string& unit);

  /// Always `value`.
  explicit TimeFunction(double value = 0.0);
  /// From a validated variant of parameter(); `name` and `unit` name it in messages. @throws Error (usage, io) when it does
  /// not describe a function: an expression with a syntax error, points out of order, a file that cannot be read.
  TimeFunction(const Options& options, std::string_view name, std::string_view unit);

  /// At time `t` [s], in the unit of the setting.
  [[nodiscard]] double value(double t) const;
  /// By time [unit/s]; from the right where there is a kink, by a central difference for an expression without `derivative`.
  [[nodiscard]] double derivative(double t) const;
  /// Over time from `a` to `b` [s], in [unit s]. Exact when has_closed_integral(), else by five points: take short spans.
  [[nodiscard]] double integral(double a, double b) const;
  [[nodiscard]] bool has_closed_integral() const;

 private:
  [[nodiscard]] double finite(double value, const char* what, double t) const;

  std::shared_ptr<const TimeLaw> law_;
  std::string name_ = "the function";
  std::string unit_;
  SourceLocation where_;
};

/// The function of time under `key`, described by TimeFunction::parameter(key, unit, ...). @throws Error as its constructor.
[[nodiscard]] TimeFunction read_time_function(const Options& options, std::string_view key, std::string_view unit);

}  // namespace scree
