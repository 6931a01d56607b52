// Parameters in words, for messages, tables and schemas.
#pragma once

#include <string>
#include <string_view>

#include "scree/config/parameter.hpp"

namespace scree {

/// What the setting must be: "a number in m or a quantity such as "3 mm"", "one of 'a' and 'b'", ...
[[nodiscard]] std::string expectation(const Parameter& parameter);

/// The valid range of each number: "above 0 m", "from 0 to 1", "at most 5 s"; empty without limits.
[[nodiscard]] std::string valid_range(const Parameter& parameter);

/// A valid line of TOML that sets it: `radius = "3 mm"`.
[[nodiscard]] std::string example_line(const Parameter& parameter);

/// A number with its unit, "-9.81 m/s2"; the shortest digits that read back the same. "1" is not printed.
[[nodiscard]] std::string quantity_text(double value, std::string_view unit);

/// A value as TOML writes it; numbers without their unit. Empty for no value.
[[nodiscard]] std::string toml_text(const Parameter::Value& value);

/// A string in quotes, escaped as TOML and JSON both read it.
[[nodiscard]] std::string quote(std::string_view text);

}  // namespace scree
