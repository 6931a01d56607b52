// The sections of a scene that belong to core, as data: what the validator, the schema and the documentation read.
#pragma once

#include <string_view>
#include <vector>

#include "scree/config/parameter.hpp"

namespace scree {

/// How often a section may occur in a scene.
enum class SectionForm {
  single,              ///< [name]
  named,               ///< [name.KEY], any number
  list,                ///< [[name]], any number
  at_most_one_plugin,  ///< [name] with `type`, whose other keys are the plugin's
  plugin_list          ///< [[name]] with `type`, whose other keys are the plugin's
};

/// One section of a scene.
struct SceneSection {
  std::string_view name;
  SectionForm form;
  std::string_view help;
  std::vector<Parameter> parameters;  ///< core's keys; of a plugin section those beside `type` and the plugin's own
};

/// All sections, in the order in which documentation shows them.
[[nodiscard]] const std::vector<SceneSection>& scene_sections();

/// One section by name. @throws std::logic_error when there is none.
[[nodiscard]] const SceneSection& scene_section(std::string_view name);

/// The members of a shape: a variant by `type`, with pose. Also used by feeds that describe shapes.
[[nodiscard]] std::vector<Variant> shape_variants();

}  // namespace scree
