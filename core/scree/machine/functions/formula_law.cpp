#include <cmath>
#include <numbers>

#include "scree/config/options.hpp"
#include "scree/machine/functions/time_law.hpp"

namespace scree {
namespace {

class Constant final : public TimeLaw {
 public:
  explicit Constant(double value) : value_{value} {}
  [[nodiscard]] double value(double) const override { return value_; }
  [[nodiscard]] double derivative(double) const override { return 0.0; }
  [[nodiscard]] double integral(double a, double b) const override { return value_ * (b - a); }

 private:
  double value_;  // [unit of the setting]
};

/// The way of a passage, from 0 to 1 while x goes from 0 to 1.
struct LinearShape {
  static double value(double x) { return x; }
  static double derivative(double) { return 1.0; }
  static double integral(double x) { return 0.5 * x * x; }
};

/// 10 x^3 - 15 x^4 + 6 x^5: first and second derivatives vanish at both ends.
struct QuinticShape {
  static double value(double x) { return x * x * x * (10.0 + x * (6.0 * x - 15.0)); }
  static double derivative(double x) { return 30.0 * x * x * (1.0 - x) * (1.0 - x); }
  static double integral(double x) { return x * x * x * x * (2.5 + x * (x - 3.0)); }
};

/// From one value to another, held before and after.
template <class Shape>
class Passage final : public TimeLaw {
 public:
  explicit Passage(const Options& o)
      : from_{o.number("from")},
        rise_{o.number("to") - from_},
        start_{o.number("start")},
        duration_{o.number("duration")} {}

  [[nodiscard]] double value(double t) const override {
    const double x = (t - start_) / duration_;
    if (x <= 0.0) return from_;
    return x >= 1.0 ? from_ + rise_ : from_ + rise_ * Shape::value(x);
  }
  [[nodiscard]] double derivative(double t) const override {
    const double x = (t - start_) / duration_;
    return x < 0.0 || x >= 1.0 ? 0.0 : rise_ / duration_ * Shape::derivative(x);
  }
  [[nodiscard]] double integral(double a, double b) const override {
    return from_ * (b - a) + rise_ * (risen(b) - risen(a));
  }

 private:
  // Integral of the shape up to t [s].
  [[nodiscard]] double risen(double t) const {
    const double x = (t - start_) / duration_;
    if (x <= 0.0) return 0.0;
    return x >= 1.0 ? duration_ * Shape::integral(1.0) + (t - start_ - duration_) : duration_ * Shape::integral(x);
  }

  double from_, rise_;       // [unit of the setting]
  double start_, duration_;  // [s]
};

class Sine final : public TimeLaw {
 public:
  explicit Sine(const Options& o)
      : mean_{o.number("mean")},
        amplitude_{o.number("amplitude")},
        turning_{2.0 * std::numbers::pi * o.number("frequency")},
        phase_{o.number("phase")} {}

  [[nodiscard]] double value(double t) const override { return mean_ + amplitude_ * std::sin(turning_ * t + phase_); }
  [[nodiscard]] double derivative(double t) const override {
    return amplitude_ * turning_ * std::cos(turning_ * t + phase_);
  }
  [[nodiscard]] double integral(double a, double b) const override {
    const double swing = std::cos(turning_ * a + phase_) - std::cos(turning_ * b + phase_);
    return mean_ * (b - a) + amplitude_ / turning_ * swing;
  }

 private:
  double mean_, amplitude_;  // [unit of the setting]
  double turning_;           // [rad/s]
  double phase_;             // [rad]
};

}  // namespace

std::unique_ptr<const TimeLaw> make_formula_law(const Options& options) {
  if (options.type() == "ramp") return std::make_unique<Passage<LinearShape>>(options);
  if (options.type() == "smooth_step") return std::make_unique<Passage<QuinticShape>>(options);
  if (options.type() == "sine") return std::make_unique<Sine>(options);
  return std::make_unique<Constant>(options.number("value"));
}

}  // namespace scree
