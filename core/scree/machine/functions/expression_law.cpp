#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <string>

#include "scree/config/options.hpp"
#include "scree/machine/functions/time_law.hpp"

namespace scree {
namespace {

constexpr const char* kVocabulary =
    "valid are the time t [s], pi, numbers, + - * / ^, comparisons, condition ? a : b, and functions such as sin, cos, "
    "exp, ln, "
    "sqrt, abs, min, max";

/// muParser evaluates through a variable that it points to: one caller at a time.
class Formula {
 public:
  Formula(const Options& o, const char* key) {
    try {
      parser_.DefineConst("pi", std::numbers::pi);
      parser_.DefineVar("t", &t_);
      parser_.SetExpr(o.text(key));
      parser_.Eval();
    } catch (const mu::Parser::exception_type& failure) {
      // muParser counts from zero, and past the end where something is missing there.
      const std::size_t at = std::min(static_cast<std::size_t>(failure.GetPos()), o.text(key).size()) + 1;
      throw o.error(key, fmt::format("is \"{}\", which is wrong at character {}: {}; {}", o.text(key), at,
                                     sentence(failure.GetMsg()), kVocabulary));
    }
    if (t_ != 0.0) throw o.error(key, "assigns to t with '='; to compare, write '=='");
  }

  double operator()(double t) {
    const std::lock_guard lock{busy_};
    t_ = t;
    return parser_.Eval();
  }

 private:
  static std::string sentence(std::string message) {
    while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
    return message;
  }

  double t_ = 0.0;  // [s]
  mu::Parser parser_;
  std::mutex busy_;
};

class Expression final : public TimeLaw {
 public:
  explicit Expression(const Options& o) : formula_{o, "expression"} {
    if (o.has("derivative")) derivative_.emplace(o, "derivative");
  }
  [[nodiscard]] double value(double t) const override { return formula_(t); }
  [[nodiscard]] double derivative(double t) const override {
    if (derivative_) return (*derivative_)(t);
    // Error of the difference h^2 f''' / 6, of rounding eps f / h: least near h = eps^(1/3).
    const double h = 6e-6 * std::max(1.0, std::abs(t));
    return (formula_(t + h) - formula_(t - h)) / (2.0 * h);
  }
  /// Gauss's rule with five points: exact for polynomials of degree nine, so meant for short spans.
  [[nodiscard]] double integral(double a, double b) const override {
    static constexpr std::array kPoints{0.0, 0.5384693101056831, 0.9061798459386640};
    static constexpr std::array kWeights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    double sum = kWeights[0] * formula_(middle);
    for (std::size_t k = 1; k < kPoints.size(); ++k) {
      sum += kWeights[k] * (formula_(middle - half * kPoints[k]) + formula_(middle + half * kPoints[k]));
    }
    return half * sum;
  }
  [[nodiscard]] bool has_closed_integral() const override { return false; }

 private:
  mutable Formula formula_;
  mutable std::optional<Formula> derivative_;
};

}  // namespace

std::unique_ptr<const TimeLaw> make_expression_law(const Options& options) {
  return std::make_unique<Expression>(options);
}

}  // namespace scree
