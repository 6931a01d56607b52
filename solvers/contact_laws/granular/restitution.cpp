#include "granular/restitution.hpp"

#include <cmath>
#include <numbers>

namespace scree::granular {
namespace {

/// theta cot(theta), which falls from 1 to 0 on [0, pi / 2].
double circular(double theta) { return theta == 0.0 ? 1.0 : theta / std::tan(theta); }
/// u coth(u), which grows from 1.
double hyperbolic(double u) { return u == 0.0 ? 1.0 : u / std::tanh(u); }

/// x in [low, high] with f(x) = 0, by bisection to the last bit; f changes its sign there. Once a pair, so it may take its
/// time.
template <class Function>
double root(double low, double high, const Function& f) {
  const bool rises = f(low) < 0.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    ((f(middle) < 0.0) == rises ? low : high) = middle;
  }
}

}  // namespace

double restitution(double zeta, EndOfContact end) {
  if (end == EndOfContact::gap)
    return zeta < 1.0 ? std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta)) : 0.0;
  return zeta < 1.0 ? std::exp(-2.0 * circular(std::acos(zeta))) : std::exp(-2.0 * hyperbolic(std::acosh(zeta)));
}

double damping_ratio(double e, EndOfContact end) {
  const double decrement = -std::log(e);
  if (decrement <= 0.0) return 0.0;
  if (end == EndOfContact::gap) return decrement / std::hypot(std::numbers::pi, decrement);
  const double half = 0.5 * decrement;
  if (half == 1.0) return 1.0;
  if (half < 1.0) {
    return std::cos(root(0.0, 0.5 * std::numbers::pi, [half](double theta) { return circular(theta) - half; }));
  }
  return std::cosh(root(0.0, half + 1.0, [half](double u) { return hyperbolic(u) - half; }));
}

std::vector<Parameter> restitution_parameters() {
  return {Parameter::choice("end_of_contact", {"no_tension", "gap"},
                            "when an impact is over: when the force of spring and dashpot is zero, or when the gap is "
                            "zero again, so that the dashpot pulls at the end")
              .by_default("no_tension"),
          Parameter::boolean("friction_in_tension",
                             "with end_of_contact = \"gap\": friction up to mu |F| also while the dashpot pulls; "
                             "false: none then")
              .by_default(true),
          Parameter::number("least_restitution", "1",
                            "a smaller restitution of a pair takes this value: damping grows without bound towards 0")
              .above(0.0)
              .at_most(1.0)
              .by_default(0.05)};
}

RestitutionOptions::RestitutionOptions(const Options& options)
    : end{options.text("end_of_contact") == "gap" ? EndOfContact::gap : EndOfContact::no_tension},
      friction_in_tension{options.boolean("friction_in_tension")},
      least{options.number("least_restitution")} {}

}  // namespace scree::granular
