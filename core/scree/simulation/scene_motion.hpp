// Scene motion: [[prescribed_motion]], from the words of a scene.
#pragma once

#include <vector>

#include "scree/config/parameter.hpp"
#include "scree/simulation/scene_model.hpp"

namespace scree {

class SceneTable;

/// The keys of [[prescribed_motion]].
[[nodiscard]] std::vector<Parameter> prescribed_motion_parameters();

/// Reads [[prescribed_motion]] and puts its bodies where they are at t = 0; bodies are known. @throws Error (usage) for a name that
/// is no kinematic body's, a body with two motions or with a velocity of its own, an axis of length zero; (usage, io) for a function or
/// a path that is none.
void read_prescribed_motions(const SceneTable& root, SceneModel& model);

}  // namespace scree
