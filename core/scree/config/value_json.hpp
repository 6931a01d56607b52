// A value of a setting as JSON. Private to core/scree/config.
#pragma once

#include <nlohmann/json.hpp>

#include "scree/config/parameter.hpp"

namespace scree {

/// Null for no value; numbers in the SI unit of their parameter.
[[nodiscard]] nlohmann::ordered_json value_to_json(const Parameter::Value& value);

}  // namespace scree
