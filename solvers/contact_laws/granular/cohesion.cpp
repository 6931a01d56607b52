#include "granular/cohesion.hpp"

#include <algorithm>
#include <numbers>

namespace scree::granular {

Parameter cohesion_parameter(bool knows_modulus) {
  std::vector<std::string> words{"none", "sced", "dmt"};
  if (knows_modulus) words.emplace_back("jkr");
  return Parameter::choice("cohesion", words,
                           knows_modulus ? "attraction of bodies that touch: none, of an energy density (sced), or of "
                                           "elastic spheres with a surface energy (dmt: stiff and small, jkr: soft and "
                                           "large)"
                                         : "attraction of bodies that touch: none, of an energy density (sced), or of "
                                           "spheres with a surface energy (dmt)")
      .by_default("none");
}

Cohesion cohesion_of(const Options& options) {
  const std::string& word = options.text("cohesion");
  if (word == "sced") return Cohesion::sced;
  if (word == "dmt") return Cohesion::dmt;
  return word == "jkr" ? Cohesion::jkr : Cohesion::none;
}

double cohesion_of_pair(Cohesion cohesion, const ContactMaterial& pair) {
  if (cohesion == Cohesion::none) return 0.0;
  return cohesion == Cohesion::sced ? pair.cohesion_energy_density : pair.surface_energy;
}

std::optional<UnreadValue> unread_cohesion(Cohesion cohesion, const ContactMaterial& pair, bool knows_modulus) {
  if (cohesion_of_pair(cohesion, pair) > 0.0) return {};
  const std::string of_surfaces = knows_modulus ? "\"dmt\" or \"jkr\"" : "\"dmt\"";
  if (cohesion == Cohesion::none) {
    const auto unread = [](const char* key, const std::string& models) {
      return UnreadValue{
          key, "with cohesion = \"none\" does not read it; set cohesion to " + models + ", or the value to 0"};
    };
    if (pair.surface_energy > 0.0) return unread("surface_energy", of_surfaces);
    if (pair.cohesion_energy_density > 0.0) return unread("cohesion_energy_density", "\"sced\"");
    return {};
  }
  if (cohesion == Cohesion::sced && pair.surface_energy > 0.0) {
    return UnreadValue{
        "surface_energy",
        "with cohesion = \"sced\" reads cohesion_energy_density; give that, or set cohesion to " + of_surfaces};
  }
  if (cohesion != Cohesion::sced && pair.cohesion_energy_density > 0.0) {
    const std::string word = cohesion == Cohesion::jkr ? "jkr" : "dmt";
    return UnreadValue{"cohesion_energy_density",
                       "with cohesion = \"" + word + "\" reads surface_energy; give that, or set cohesion to \"sced\""};
  }
  return {};
}

std::optional<std::string> idle_cohesion(Cohesion cohesion, const Materials& materials, const SourceLocation& where) {
  if (cohesion == Cohesion::none) return {};
  for (std::uint32_t a = 0; a < materials.size(); ++a) {
    for (std::uint32_t b = a; b < materials.size(); ++b) {
      if (cohesion_of_pair(cohesion, materials.pair(a, b)) > 0.0) return {};
    }
  }
  const char* word = cohesion == Cohesion::sced ? "sced" : cohesion == Cohesion::dmt ? "dmt" : "jkr";
  const char* key = cohesion == Cohesion::sced ? "cohesion_energy_density" : "surface_energy";
  return "warning: " + to_prefix(where) + "cohesion = \"" + word + "\" has no effect: " + key +
         " of all pairs of materials is 0; set it in [material.NAME] or [[material_pair]]";
}

void add_cohesion(Cohesion cohesion, const PairColumn& column, const ContactBatch& __restrict batch,
                  ContactLanes& __restrict lanes) {
  if (cohesion != Cohesion::sced && cohesion != Cohesion::dmt) return;
  alignas(64) Lane energy;
  spread(column, batch, energy);
  const bool by_area = cohesion == Cohesion::sced;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double depth = by_area ? std::max(batch.overlap[k], 0.0) : 1.0;
    const double pull = 2.0 * std::numbers::pi * batch.radius[k] * energy[k] * depth;
    lanes.normal[k] -= lanes.stiffness[k] > 0.0 ? pull : 0.0;
  }
}

}  // namespace scree::granular
