#include "scree/simulation/stepper_needs.hpp"

#include <string>

namespace scree {
namespace {

void check_solver(const Parts& parts) {
  if (!parts.stepper.plugin->needs_ccp_solver() || parts.solver) return;
  throw parts.stepper.options.error(parts.stepper.info.label() +
                                    " solves a contact problem in every step, but the scene has no [ccp_solver]; add "
                                    "one with `type`");
}

void check_narrow_phase(const Parts& parts, const CollisionPipeline& pipeline, const BodyView& bodies) {
  const std::string missing = "but the scene has no [[narrow_phase]]; add one with `type`";
  if (!parts.narrow.empty()) return pipeline.check_support(bodies);
  // What sources add is not known before they do.
  if (parts.stepper.plugin->needs_ccp_solver() && !parts.sources.empty()) {
    throw parts.sources[0].options.error(parts.sources[0].info.label() + " adds bodies that may touch, " + missing);
  }
  try {
    pipeline.check_support(bodies);
  } catch (const Error&) {
    throw parts.stepper.options.error("bodies of the scene may touch, " + missing);
  }
}

void check_rolling(const TimeStepper& stepper, const std::string& label, const Options& contact) {
  if (stepper.resists_rolling()) return;
  for (const char* key : {"rolling_friction", "spinning_friction"}) {
    if (contact.number(key) == 0.0) continue;
    throw contact.error(
        key, "is not zero, but " + label + " does not resist rolling or spinning; set it to 0 or take it away");
  }
}

void check_joints(const Parts& parts, const SceneModel& model) {
  if (parts.stepper.plugin->holds_joints() || model.machine_options.empty()) return;
  throw model.machine_options.front().second.error(
      "the scene has joints, but " + parts.stepper.info.label() +
      " does not hold any; take a stepper that does, such as dvi, or take the joints away");
}

}  // namespace

void check_stepper_needs(const Parts& parts, const SceneModel& model, const CollisionPipeline& pipeline,
                         const BodyView& bodies) {
  check_solver(parts);
  check_joints(parts, model);
  check_narrow_phase(parts, pipeline, bodies);
  const std::string label = parts.stepper.info.label();
  for (const NamedOptions& material : model.material_options) {
    check_rolling(*parts.stepper.plugin, label, material.options);
  }
  for (const Options& pair : model.pair_options) check_rolling(*parts.stepper.plugin, label, pair);
}

}  // namespace scree
