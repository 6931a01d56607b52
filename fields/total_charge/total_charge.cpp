#include "total_charge.hpp"

#include <algorithm>

#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"

namespace scree {

TotalCharge::TotalCharge(const Options& options) : names_{options.texts("terms")} {
  if (std::find(names_.begin(), names_.end(), "charge") != names_.end())
    throw options.error("terms", "must not hold 'charge' itself; name the columns that it is the sum of");
}

std::vector<Parameter> TotalCharge::parameters() {
  return {Parameter::texts("terms", "columns [C] whose sum is the charge; those that no part writes count as zero")
              .by_default(std::vector<std::string>{"charge_induced", "charge_corona"})};
}

void TotalCharge::setup(SceneServices& services) {
  terms_.clear();
  for (const std::string& name : names_)
    terms_.push_back(services.optional_attribute({name, "C", "a part of the charge", 0.0, {}}));
  charge_ = services.provide_attribute({"charge", "C", "charge, the sum over all that charges a body", 0.0, {}});
}

void TotalCharge::add_forces(const BodyView&, double, WrenchView) const {}

void TotalCharge::advance(const BodyView&, const ContactView&, Attributes& attributes, double, double) {
  const std::span<double> charge = attributes.column(charge_);
  std::fill(charge.begin(), charge.end(), 0.0);
  for (const AttributeId term : terms_) {
    const std::span<const double> part = attributes.column(term);
    for (std::size_t i = 0; i < charge.size(); ++i) charge[i] += part[i];
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ForceField, scree::TotalCharge>("total_charge", "The reported sum of all charges of a body.",
                                                     scree::TotalCharge::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("total_charge", "1.0.0", &list)};
