// JSON Schema (draft 2020-12) of scenes, made from the Parameters of core and of the plugins, for editors.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scree/config/parameter.hpp"

namespace scree {

/// A plugin as the schema knows it: the value of `type`, and the settings that go with it.
struct SchemaPlugin {
  std::string name;
  std::string help;
  std::vector<Parameter> parameters;
};

/// A top-level table of a scene, `[key]`; or a list of them, `[[key]]`; or named ones, `[key.NAME]`.
struct SchemaSection {
  std::string key;
  std::string help;
  bool is_list = false;
  bool required = false;
  std::vector<Parameter> parameters{};  ///< core's own keys; they go with every plugin
  std::vector<SchemaPlugin> plugins{};  ///< when not empty, `type` chooses one of them
  bool is_named = false;                ///< tables by free names, `[key.NAME]`
};

/// The schema of one table with these settings, as JSON text.
[[nodiscard]] std::string parameters_to_schema(std::span<const Parameter> parameters);

/// The schema of a whole scene, as JSON text: its sections, keys outside of any section, and `include`.
[[nodiscard]] std::string scene_schema(std::span<const SchemaSection> sections,
                                       std::span<const Parameter> root_parameters = {});

}  // namespace scree
