#include "scree/simulation/stepper_needs.hpp"

#include <string>

#include "scree/interfaces/contact_reader.hpp"

namespace scree {
namespace {

void check_solver(const Parts& parts) {
  if (!parts.stepper.plugin->needs_ccp_solver() || parts.solver) return;
  throw parts.stepper.options.error(parts.stepper.info.label() +
                                    " solves a contact problem in every step, but the scene has no [ccp_solver]; add "
                                    "one with `type`");
}

void check_law(const Parts& parts) {
  if (!parts.stepper.plugin->needs_contact_law() || parts.law) return;
  throw parts.stepper.options.error(
      parts.stepper.info.label() +
      " has soft contacts, but the scene has no [contact_law]; add one with `type`, such as "
      "linear_spring_dashpot");
}

void check_narrow_phase(const Parts& parts, const CollisionPipeline& pipeline, const BodyView& bodies) {
  const std::string missing = "but the scene has no [[narrow_phase]]; add one with `type`";
  if (!parts.narrow.empty()) return pipeline.check_support(bodies);
  // What sources add is not known before they do.
  const TimeStepper& stepper = *parts.stepper.plugin;
  if ((stepper.needs_ccp_solver() || stepper.needs_contact_law()) && !parts.sources.empty()) {
    throw parts.sources[0].options.error(parts.sources[0].info.label() + " adds bodies that may touch, " + missing);
  }
  try {
    pipeline.check_support(bodies);
  } catch (const Error&) {
    throw parts.stepper.options.error("bodies of the scene may touch, " + missing);
  }
}

/// Refuses what a contact asks for and neither stepper nor law does. `values` are those of `contact`.
void check_contact(const Parts& parts, const Options& contact, const ContactMaterial& values) {
  const bool soft = parts.stepper.plugin->needs_contact_law();
  const std::string label = soft ? parts.law->info.label() : parts.stepper.info.label();
  const bool rolls = soft ? parts.law->plugin->resists_rolling() : parts.stepper.plugin->resists_rolling();
  const bool coheres = soft && parts.law->plugin->coheres();
  // A law whose settings decide knows what to do better than what follows.
  const auto* reader = soft ? dynamic_cast<const ContactReader*>(parts.law->plugin.get()) : nullptr;
  if (reader != nullptr) {
    if (const auto unread = reader->unread(values)) {
      throw contact.error(unread->key, "is not zero, but " + label + " " + unread->sentence);
    }
  }
  const auto refuse = [&](const char* key, const char* what) {
    if (contact.number(key) == 0.0) return;
    throw contact.error(key, "is not zero, but " + label + " does not " + what + "; set it to 0 or take it away");
  };
  if (!rolls) {
    refuse("rolling_friction", "resist rolling or spinning");
    refuse("spinning_friction", "resist rolling or spinning");
  }
  if (!coheres) {
    refuse("surface_energy", "let bodies attract each other");
    refuse("cohesion_energy_density", "let bodies attract each other");
  }
}

const ContactMaterial& values_of(const Materials& materials, const Options& pair) {
  const std::vector<std::string>& names = pair.texts("between");
  return materials.pair(static_cast<std::uint32_t>(materials.find(names[0])),
                        static_cast<std::uint32_t>(materials.find(names[1])));
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
  check_law(parts);
  check_joints(parts, model);
  check_narrow_phase(parts, pipeline, bodies);
  for (std::uint32_t m = 0; m < model.materials.size(); ++m) {
    check_contact(parts, model.material_options[m].options, model.materials[m].contact);
  }
  for (const Options& pair : model.pair_options) check_contact(parts, pair, values_of(model.materials, pair));
}

}  // namespace scree
