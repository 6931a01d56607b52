// SceneModel: the materials, shapes and bodies that a scene describes.
#pragma once

#include <string>
#include <vector>

#include "scree/config/options.hpp"
#include "scree/machine/machine_row.hpp"
#include "scree/machine/prescribed/prescribed_motion.hpp"
#include "scree/model/body_store.hpp"
#include "scree/model/material.hpp"
#include "scree/model/shape_set.hpp"
#include "scree/simulation/shape_builder.hpp"

namespace scree {

class SceneDocument;

/// A body of the scene, before attributes are known.
struct SceneBody {
  std::string name;  ///< may be empty
  NewBody body;
  std::string shape;
  Options options;
};

/// A validated table `[section.NAME]`.
struct NamedOptions {
  std::string name;
  Options options;
};

/// What a scene says about matter, validated.
struct SceneModel {
  Options simulation;
  Options contacts;
  Options output;
  std::vector<NamedOptions> material_options;
  std::vector<Options> pair_options;
  std::vector<NamedOptions> shape_options;
  Materials materials;
  ShapeSet shapes;
  std::vector<SceneBody> bodies;
  std::vector<std::string> collision_groups{"default"};  ///< by CollisionGroup
  std::vector<NamedOptions> collision_group_options;
  std::vector<Options> excluded_pair_options;
  std::vector<PrescribedMotion> motions;
  std::vector<Options> motion_options;
  MachineDescription machine;
  std::vector<std::pair<std::string, Options>> machine_options;  ///< joints, then motors, then couplings; by section
  ShapeRemarks remarks;
};

/// Reads and checks the sections that describe matter. @throws Error (usage, io) at the place in the scene.
[[nodiscard]] SceneModel read_scene_model(const SceneDocument& document);

/// Refuses sections that core does not know. @throws Error (usage) with a suggestion.
void check_section_names(const SceneDocument& document);

}  // namespace scree
