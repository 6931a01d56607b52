#include "side_envelope.hpp"

#include <cmath>

namespace scree {
namespace {

// Distance of the point of half strength from the machine's side, fitted to the published machine [m].
constexpr double kHalfStrengthBeyondSide = 0.027;

}  // namespace

SideEnvelope::SideEnvelope(const Options& options)
    : kind_{options.text("envelope") == "none"     ? Kind::none
            : options.text("envelope") == "cutoff" ? Kind::cutoff
                                                   : Kind::tanh},
      half_width_{options.number("half_width")},
      decay_position_{options.has("decay_position") ? options.number("decay_position")
                                                    : half_width_ + kHalfStrengthBeyondSide},
      decay_length_{options.number("decay_length")} {}

std::vector<Parameter> SideEnvelope::parameters() {
  return {
      Parameter::choice("envelope", {"none", "cutoff", "tanh"}, "how the field fades past the sides of the machine")
          .by_default("none"),
      Parameter::number("half_width", "m", "half the width of the machine along the roll's axis")
          .above(0.0)
          .by_default(0.15),
      Parameter::number("decay_position", "m",
                        "tanh: distance from the middle at which the field has halved; half_width + 27 mm when absent")
          .above(0.0)
          .optional(),
      Parameter::number("decay_length", "m", "tanh: length of the decay").above(0.0).by_default(0.054),
  };
}

double SideEnvelope::operator()(double z) const {
  switch (kind_) {
    case Kind::none:
      return 1.0;
    case Kind::cutoff:
      return std::abs(z) <= half_width_ ? 1.0 : 0.0;
    case Kind::tanh:
      return 0.5 * (1.0 - std::tanh((std::abs(z) - decay_position_) / decay_length_));
  }
  return 1.0;
}

}  // namespace scree
