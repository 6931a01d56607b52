// Parameters as a plain-text table, for `scree plugins show`.
#pragma once

#include <span>
#include <string>

#include "scree/config/parameter.hpp"

namespace scree {

/// One line a setting: name, kind and unit, default, valid values, help; members of tables and variants indented below.
/// Lines begin with two spaces; empty text for no parameters.
[[nodiscard]] std::string describe_parameters(std::span<const Parameter> parameters);

}  // namespace scree
