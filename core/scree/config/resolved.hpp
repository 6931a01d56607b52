// Validated settings as text, with all defaults filled in: what a run really used.
#pragma once

#include <string>

#include "scree/config/options.hpp"

namespace scree {

/// A JSON object: numbers in SI, file names as the scene wrote them, `type` first where the table has one; settings
/// without a value are left out. `indent` spaces a level, or one line for -1.
[[nodiscard]] std::string to_json_text(const Options& options, int indent = 2);

/// The same as TOML, which validates to equal Options.
[[nodiscard]] std::string to_toml_text(const Options& options);

}  // namespace scree
