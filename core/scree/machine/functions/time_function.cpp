#include "scree/machine/functions/time_function.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scree/config/options.hpp"
#include "scree/machine/functions/time_law.hpp"

namespace scree {
namespace {

std::unique_ptr<const TimeLaw> make_law(const Options& options) {
  if (options.type() == "table") return make_table_law(options);
  if (options.type() == "expression") return make_expression_law(options);
  return make_formula_law(options);
}

Options constant(double value) {
  Options options;
  options.set_type("constant");
  options.set("value", Parameter::Value{value});
  return options;
}

std::vector<Parameter> passage(const std::string& unit) {
  return {Parameter::number("from", unit, "value until the start").by_default(0.0),
          Parameter::number("to", unit, "value from the end on"),
          Parameter::number("start", "s", "time at which it begins to change").by_default(0.0),
          Parameter::number("duration", "s", "time that the change takes").above(0.0)};
}

Variant table_variant(const std::string& unit) {
  return {"table",
          "Through points, listed or in a file.",
          {Parameter::numbers("times", "s", "of the points, ascending").optional(),
           Parameter::numbers("values", unit, "at the times").optional(),
           Parameter::path("file", "text file with a row of time [s] and value, in SI, a line").optional(),
           Parameter::choice("interpolation", {"linear", "monotone_cubic"},
                             "straight between the points, or smooth without overshoot")
               .by_default("linear"),
           Parameter::choice("outside", {"hold", "repeat"},
                             "before the first point and after the last: their values, or the points over and over")
               .by_default("hold")}};
}

}  // namespace

std::vector<Variant> TimeFunction::variants(const std::string& unit) {
  return {{"constant", "Always the same.", {Parameter::number("value", unit, "the value")}},
          {"ramp", "From one value to another in a straight line.", passage(unit)},
          {"smooth_step", "From one value to another without a jerk: first and second derivatives are continuous.",
           passage(unit)},
          {"sine",
           "mean + amplitude sin(2 pi frequency t + phase).",
           {Parameter::number("mean", unit, "about which it swings").by_default(0.0),
            Parameter::number("amplitude", unit, "greatest deviation from the mean"),
            Parameter::number("frequency", "Hz", "periods a second").above(0.0),
            Parameter::number("phase", "rad", "at t = 0").by_default(0.0)}},
          table_variant(unit),
          {"expression",
           "A formula in the time t [s].",
           {Parameter::text("expression", "in t [s] and pi, its result in " + (unit == "1" ? "plain numbers" : unit)),
            Parameter::text("derivative", "formula of its derivative by t; by differences when left out").optional()}}};
}

Parameter TimeFunction::parameter(std::string name, const std::string& unit, std::string help) {
  return Parameter::variant(std::move(name), variants(unit), std::move(help)).with_shorthand("constant", "value");
}

TimeFunction::TimeFunction(double value) : law_{make_formula_law(constant(value))} {}

TimeFunction::TimeFunction(const Options& options, std::string_view name, std::string_view unit)
    : law_{make_law(options)}, name_{fmt::format("'{}'", name)}, unit_{unit}, where_{options.location()} {}

double TimeFunction::finite(double value, const char* what, double t) const {
  if (std::isfinite(value)) return value;
  throw Error{ErrorKind::usage, where_,
              fmt::format("{}{} is {}{} at t = {} s; a function of time must be finite at all times of the run", what,
                          name_, value, unit_ == "1" || unit_.empty() ? "" : " " + unit_, t)};
}

double TimeFunction::value(double t) const { return finite(law_->value(t), "", t); }
double TimeFunction::derivative(double t) const { return finite(law_->derivative(t), "the derivative of ", t); }
double TimeFunction::integral(double a, double b) const { return finite(law_->integral(a, b), "the integral of ", b); }
bool TimeFunction::has_closed_integral() const { return law_->has_closed_integral(); }

TimeFunction read_time_function(const Options& options, std::string_view key, std::string_view unit) {
  return TimeFunction{options.table(key), key, unit};
}

}  // namespace scree
