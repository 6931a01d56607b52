// Scene machine: joints, motors and couplings, from the words of a scene.
#pragma once

#include <vector>

#include "scree/machine/machine_row.hpp"
#include "scree/simulation/scene_model.hpp"
#include "scree/simulation/scene_sections.hpp"

namespace scree {

class CollisionFilter;
class Machine;
class SceneTable;

/// The sections [[joint]], [[motor]] and [[coupling]], as data.
[[nodiscard]] std::vector<SceneSection> machine_sections();
/// The key `frames` of a body.
[[nodiscard]] Parameter frames_parameter();

/// Reads the machine; bodies are known. @throws Error (usage) at the place of a name that is none, a joint that ties nothing,
/// an axis without direction, motors that contradict each other.
void read_machine(const SceneTable& root, SceneModel& model);

/// Puts the joints together, or refuses to (joint_assembly.hpp), and tells of it in `log`. Joints whose equations repeat
/// others are told of too. @throws Error (usage) naming the joint and its error.
void assemble_machine(SceneModel& model, std::vector<std::string>& log);

/// Bodies that a joint ties do not touch each other, unless it says so.
void exclude_joined(const SceneModel& model, CollisionFilter& filter);

/// The same for joints that are gone: their bodies meet again. `known` says which were told of, by joint.
void admit_parted(const SceneModel& model, const Machine& machine, std::vector<char>& known, CollisionFilter& filter);

}  // namespace scree
