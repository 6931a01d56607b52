// What a time stepper needs of the scene, checked before the first step.
#pragma once

#include "scree/collision/collision_pipeline.hpp"
#include "scree/simulation/parts.hpp"
#include "scree/simulation/scene_model.hpp"

namespace scree {

/// Refuses a scene that lacks what its time stepper declares to need, or asks for what it declares not to do.
/// `bodies` are those of the scene. @throws Error (usage) at the place in the scene.
void check_stepper_needs(const Parts& parts, const SceneModel& model, const CollisionPipeline& pipeline,
                         const BodyView& bodies);

}  // namespace scree
