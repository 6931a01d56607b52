// One value of a scene, checked against its Parameter. Private to core/scree/config.
#pragma once

#include <string>

#include "scree/config/options.hpp"
#include "scree/config/parameter.hpp"
#include "scree/config/scene_node.hpp"

namespace scree {

/// The value of a boolean, number, text, choice, path, vector or list; `subject` names it in messages, for example
/// "'radius' of force_field 'drag'". @throws Error (usage) at the value's place.
[[nodiscard]] Parameter::Value read_plain_value(const SceneNode& node, const Parameter& parameter,
                                                const std::string& subject);

/// "'radius' of force_field 'drag' must be a number in m ..., but is a table", at the value's place.
[[noreturn]] void refuse_kind(const SceneNode& node, const Parameter& parameter, const std::string& subject);

/// Checks the length of a list. @throws Error (usage)
void check_count(const SceneNode& list, const Parameter& parameter, const std::string& subject);

}  // namespace scree
