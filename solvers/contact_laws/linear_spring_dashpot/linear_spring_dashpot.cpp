#include "linear_spring_dashpot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "granular/step_limit.hpp"
#include "granular/tangential_spring.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"

namespace scree {

using granular::ContactLanes;
using granular::Lane;

LinearSpringDashpot::LinearSpringDashpot(const Options& options)
    : pairs_{options},
      stiffness_ratio_{options.number("tangential_stiffness_ratio")},
      damping_ratio_{options.number("tangential_damping_ratio")},
      rolling_{options},
      cohesion_{granular::cohesion_of(options)},
      cohesion_place_{options.location("cohesion")} {}

std::vector<Parameter> LinearSpringDashpot::parameters() {
  std::vector<Parameter> list = LinearPairs::parameters();
  list.push_back(Parameter::number("tangential_stiffness_ratio", "1",
                                   "tangential over normal stiffness; with 2/7 solid spheres swing along the surface "
                                   "as fast as along the normal")
                     .at_least(0.0)
                     .by_default(granular::kTangentMass));
  list.push_back(
      Parameter::number("tangential_damping_ratio", "1",
                        "tangential over normal damping; with 2/7, as with the stiffness, both damp with one ratio")
          .at_least(0.0)
          .by_default(granular::kTangentMass));
  for (Parameter& parameter : granular::RollingResistance::parameters()) list.push_back(std::move(parameter));
  list.push_back(granular::cohesion_parameter(false));
  return list;
}

void LinearSpringDashpot::setup(SceneServices& services) {
  const Materials& materials = services.materials();
  pairs_.setup(materials);
  rolling_.setup(materials);
  if (const auto warning = granular::idle_cohesion(cohesion_, materials, cohesion_place_)) services.log(*warning);
  cohesion_column_.clear();
  for (std::uint32_t a = 0; a < materials.size(); ++a) {
    for (std::uint32_t b = 0; b < materials.size(); ++b) {
      cohesion_column_.push_back(granular::cohesion_of_pair(cohesion_, materials.pair(a, b)));
      if (a <= b) services.log(pairs_.describe(materials, a, b));
    }
  }
}

std::optional<UnreadValue> LinearSpringDashpot::unread(const ContactMaterial& values) const {
  const auto turning = rolling_.unread(values);
  return turning ? turning : granular::unread_cohesion(cohesion_, values, false);
}

std::size_t LinearSpringDashpot::history_size() const { return granular::kTangentialHistory + rolling_.history_size(); }

double LinearSpringDashpot::stable_step(const ContactScale& contact) const {
  const std::size_t pair = pairs_.index(contact.material_a, contact.material_b);
  const double k = pairs_.stiffness(pair, contact.mass, contact.radius), rate = std::sqrt(k / contact.mass);
  const double c = pairs_.damping(pair, k, contact.mass), zeta = 0.5 * c / std::sqrt(k * contact.mass);
  const double time = std::numbers::pi / rate / (zeta < 1.0 ? std::sqrt(1.0 - zeta * zeta) : 1.0);
  const double across = granular::longest_stable_step(contact.mass, k, c);
  const double along =
      granular::longest_stable_step(granular::kTangentMass * contact.mass, stiffness_ratio_ * k, damping_ratio_ * c);
  const double turning = rate * rolling_.rate(pair, contact.radius), roll = turning > 0.0 ? 2.0 / turning : time;
  return std::min({time / 20.0, granular::kPartOfStable * std::min({across, along, roll})});
}

// Normal force without cohesion, and what friction needs.
void LinearSpringDashpot::push(ContactBatch& __restrict batch, ContactLanes& __restrict lanes) const {
  alignas(64) Lane damping;
  pairs_.find_stiffness(batch, lanes.stiffness);
  pairs_.find_damping(batch, lanes.stiffness, damping);
  const double least = pairs_.end().least_force(), tail = pairs_.end().tail();
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double touching = batch.overlap[k] >= 0.0 ? 1.0 : 0.0;
    const double stiffness = touching * lanes.stiffness[k], c = touching * damping[k];
    const double force = std::max(stiffness * batch.overlap[k] + c * lanes.approach[k], least);
    lanes.stiffness[k] = stiffness;
    lanes.normal[k] = force;
    lanes.load[k] = std::max(force, tail * force);
    lanes.tangent_stiffness[k] = stiffness_ratio_ * stiffness;
    lanes.tangent_damping[k] = damping_ratio_ * c;
  }
}

void LinearSpringDashpot::forces(ContactBatch& batch) const {
  ContactLanes lanes;
  alignas(64) Lane friction;
  granular::find_approach(batch, lanes);
  push(batch, lanes);
  granular::add_cohesion(cohesion_, cohesion_column_, batch, lanes);
  pairs_.find_friction(batch, friction);
  granular::add_tangential_spring(batch, lanes, friction);
  rolling_.add(batch, lanes, granular::kTangentialHistory);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ContactLaw, scree::LinearSpringDashpot>(
      "linear_spring_dashpot", "Linear springs and dashpots with Coulomb friction, after Cundall and Strack.",
      scree::LinearSpringDashpot::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("linear_spring_dashpot", "1.0.0", &list)};
