// Quantities with units, as scenes write them: "35 kV", "44.8 rpm", "3 mm", "2.5 g/cm3", "30 deg".
#pragma once

#include <string>
#include <string_view>

namespace scree {

/// As the unit of a description: any dimension; quantities become numbers of the SI unit of their own dimension. For
/// values whose unit only the reader knows, such as body attributes.
inline constexpr std::string_view kAnyUnit = "any";

/// The value of `text` in the SI unit `unit` ("m", "m/s2", "1", "kg/m3", "rad/s", ...). Angles are a dimension of their
/// own here: "50 Hz" is not accepted for "rad/s", since it could mean 50 rad/s or 50 turns a second. Thread-safe.
/// @throws Error (usage, no place) when the number or the unit cannot be read, or the dimensions differ; the sentence
/// names both units and an example that would be valid.
[[nodiscard]] double parse_quantity(std::string_view text, std::string_view unit);

/// A valid quantity of the SI unit `unit`, for messages: "3 mm" for "m", "44.8 rpm" for "rad/s".
[[nodiscard]] std::string quantity_example(std::string_view unit);

/// True when the unit library knows `unit`; descriptions of parameters are tested with this.
[[nodiscard]] bool is_unit(std::string_view unit);

}  // namespace scree
