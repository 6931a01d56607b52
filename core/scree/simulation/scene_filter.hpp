// Scene filter: collision groups and excluded pairs, from the words of a scene.
#pragma once

#include "scree/collision/collision_filter.hpp"
#include "scree/simulation/scene_model.hpp"

namespace scree {

class SceneTable;

/// Reads [collision_group.NAME]. @throws Error (usage) for a name that is no group, or too many groups.
void read_collision_groups(const SceneTable& root, SceneModel& model);

/// Reads [[excluded_pair]]; bodies are known. @throws Error (usage) for a name that is no body's, or one name twice.
void read_excluded_pairs(const SceneTable& root, SceneModel& model);

/// The group that `options`, of a body or a source, name as `collision_group`. @throws Error (usage) when there is none.
[[nodiscard]] CollisionGroup find_collision_group(const SceneModel& model, const Options& options);

/// What the scene says about who meets whom. Bodies of the scene have their place in it as id.
void fill_filter(const SceneModel& model, CollisionFilter& filter);

}  // namespace scree
