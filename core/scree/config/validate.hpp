// From the words of a scene to validated Options.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/config/parameter.hpp"

namespace scree {

class SceneTable;

/// Checks a table of a scene against its description, converts units and fills in defaults.
/// `what` names the table in messages, for example "force_field 'drag'".
/// @throws Error (usage) at file:line:column for an unknown key (with the nearest valid one), a missing key, a wrong
/// kind, a wrong unit or a value out of range.
[[nodiscard]] Options validate(const SceneTable& table, const std::vector<Parameter>& parameters,
                               std::string_view what);

/// The Options that an empty table would give: all defaults. Required settings are left out.
[[nodiscard]] Options default_options(const std::vector<Parameter>& parameters);

/// For tests and C++ callers: TOML text validated as one table. @throws Error as validate() does.
[[nodiscard]] Options options_from_text(std::string_view toml, const std::vector<Parameter>& parameters);

}  // namespace scree
