// Functions of time from a line of TOML, for unit tests.
#pragma once

#include <string>

#include "scree/config/options.hpp"
#include "scree/config/validate.hpp"
#include "scree/machine/functions/time_function.hpp"

namespace scree::test {

/// The function that `x = <toml>` describes, in metres.
inline TimeFunction function_of(const std::string& toml) {
  return read_time_function(options_from_text("x = " + toml, {TimeFunction::parameter("x", "m", "a way")}), "x", "m");
}

/// The text of the Error that `x = <toml>` gives, or "".
inline std::string refusal_of(const std::string& toml) {
  try {
    static_cast<void>(function_of(toml));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace scree::test
