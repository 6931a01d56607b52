#include "hertz_mindlin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "granular/jkr_neck.hpp"
#include "granular/step_limit.hpp"
#include "granular/tangential_spring.hpp"
#include "scree/interfaces/plugin_library.hpp"

namespace scree {

using granular::ContactLanes;
using granular::Lane;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDashpot = 1.8257418583505538;  ///< 2 sqrt(5/6): damping over zeta sqrt(m dF/dx)
constexpr double kImpact =
    4.030;  ///< time of an elastic impact times sqrt(dF/dx / m) at its deepest, sqrt(15 / 8) 2.943
constexpr std::size_t kRadiusSlot = granular::kTangentialHistory;  ///< of the circle of contact of the step before [m]
constexpr std::size_t kNeckSlot = kRadiusSlot + 1;

}  // namespace

HertzMindlin::HertzMindlin(const Options& options)
    : pairs_{options},
      fraction_{options.number("rayleigh_fraction")},
      tangential_damping_{options.number("tangential_damping")},
      rolling_{options},
      cohesion_{granular::cohesion_of(options)},
      cohesion_place_{options.location("cohesion")} {}

std::vector<Parameter> HertzMindlin::parameters() {
  std::vector<Parameter> list = ElasticPairs::parameters();
  list.push_back(Parameter::number("tangential_damping", "1", "factor on the dashpot along the surface")
                     .at_least(0.0)
                     .by_default(1.0));
  list.push_back(Parameter::number("rayleigh_fraction", "1", "stable step over Rayleigh's time")
                     .above(0.0)
                     .at_most(1.0)
                     .by_default(0.2));
  for (Parameter& parameter : granular::RollingResistance::parameters()) list.push_back(std::move(parameter));
  list.push_back(granular::cohesion_parameter(true));
  return list;
}

void HertzMindlin::setup(SceneServices& services) {
  const Materials& materials = services.materials();
  pairs_.setup(services, cohesion_);
  rolling_.setup(materials);
  if (const auto warning = granular::idle_cohesion(cohesion_, materials, cohesion_place_)) services.log(*warning);
  for (std::uint32_t a = 0; a < materials.size(); ++a)
    for (std::uint32_t b = a; b < materials.size(); ++b) services.log(pairs_.describe(materials, a, b));
}

std::optional<UnreadValue> HertzMindlin::unread(const ContactMaterial& values) const {
  const auto turning = rolling_.unread(values);
  return turning ? turning : granular::unread_cohesion(cohesion_, values, true);
}

std::size_t HertzMindlin::history_size() const {
  return kRadiusSlot + 1 + (has_necks() ? 1U : 0U) + rolling_.history_size();
}

double HertzMindlin::reach(double radius) const {
  double farthest = 0.0;
  if (!has_necks()) return farthest;
  for (std::size_t pair = 0; pair < pairs_.modulus.size(); ++pair) {
    if (pairs_.modulus[pair] > 0.0)
      farthest = std::max(farthest, granular::neck_reach(pairs_.adhesion[pair], pairs_.modulus[pair], radius));
  }
  return farthest;
}

double HertzMindlin::stable_step(const ContactScale& contact) const {
  pairs_.require_elastic(contact.material_a, contact.material_b);
  const std::size_t pair = pairs_.index(contact.material_a, contact.material_b);
  const double e = pairs_.modulus[pair], m = contact.mass, r = contact.radius, v = contact.speed;
  double step = fraction_ * std::min(pairs_.rayleigh_time(contact.material_a, m, r),
                                     pairs_.rayleigh_time(contact.material_b, m, r));
  // The circle of contact at its greatest: of an impact, or of a neck at rest.
  const double impact = std::sqrt(r * std::pow(15.0 * m * v * v / (16.0 * e * std::sqrt(r)), 0.4));
  const double neck = has_necks() ? std::cbrt(4.5 * kPi * pairs_.adhesion[pair] * r * r / e) : 0.0;
  const double a = std::max(impact, neck);
  if (a == 0.0) return step;
  const double kn = 2.0 * e * a, kt = 8.0 * pairs_.shear[pair] * a, zeta = kDashpot * pairs_.ratio[pair];
  const double rate = std::sqrt(kn / m), turning = rate * rolling_.rate(pair, r);
  step = std::min(step, kImpact / 20.0 / rate);
  step = std::min(step, granular::kPartOfStable * granular::longest_stable_step(m, kn, zeta * std::sqrt(kn * m)));
  step = std::min(
      step, granular::kPartOfStable * granular::longest_stable_step(granular::kTangentMass * m, kt,
                                                                    tangential_damping_ * zeta * std::sqrt(kt * m)));
  return turning > 0.0 ? std::min(step, 2.0 * granular::kPartOfStable / turning) : step;
}

// What follows from the circle of contact and from lanes.normal, the elastic force.
void HertzMindlin::finish(ContactBatch& __restrict batch, ContactLanes& __restrict lanes,
                          const Lane& __restrict modulus, const Lane& __restrict pull_off) const {
  alignas(64) Lane shear, ratio;
  granular::spread(pairs_.shear, batch, shear);
  granular::spread(pairs_.ratio, batch, ratio);
  const double least = pairs_.end.least_force(), tail = pairs_.end.tail();
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double a = lanes.contact_radius[k], mass = batch.mass[k], zeta = kDashpot * ratio[k];
    const double kn = 2.0 * modulus[k] * a, kt = 8.0 * shear[k] * a;
    const double force =
        std::max(lanes.normal[k] + zeta * std::sqrt(kn * mass) * lanes.approach[k], least - pull_off[k]);
    const double pressed = force + 2.0 * pull_off[k];
    lanes.stiffness[k] = kn;
    lanes.normal[k] = a > 0.0 ? force : 0.0;
    lanes.load[k] = a > 0.0 ? std::max(pressed, tail * pressed) : 0.0;
    lanes.tangent_stiffness[k] = kt;
    lanes.tangent_damping[k] = tangential_damping_ * zeta * std::sqrt(kt * mass);
  }
}

void HertzMindlin::press(ContactBatch& __restrict batch, ContactLanes& __restrict lanes) const {
  alignas(64) Lane modulus, none;
  granular::spread(pairs_.modulus, batch, modulus);
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double overlap = std::max(batch.overlap[k], 0.0), a = std::sqrt(batch.radius[k] * overlap);
    lanes.contact_radius[k] = a;
    lanes.normal[k] = 4.0 / 3.0 * modulus[k] * a * overlap;
    none[k] = 0.0;
  }
  finish(batch, lanes, modulus, none);
  granular::add_cohesion(cohesion_, pairs_.adhesion, batch, lanes);
}

void HertzMindlin::press_necks(ContactBatch& __restrict batch, ContactLanes& __restrict lanes) const {
  alignas(64) Lane modulus, pull_off;
  granular::spread(pairs_.modulus, batch, modulus);
  granular::spread(pairs_.adhesion, batch, pull_off);
  granular::find_necks(batch, pull_off, modulus, kNeckSlot, lanes);
  for (std::size_t k = 0; k < batch.count; ++k) pull_off[k] *= 1.5 * kPi * batch.radius[k];
  finish(batch, lanes, modulus, pull_off);
}

void HertzMindlin::forces(ContactBatch& batch) const {
  ContactLanes lanes;
  alignas(64) Lane friction, shrinks;
  granular::find_approach(batch, lanes);
  if (has_necks()) {
    press_necks(batch, lanes);
  } else {
    press(batch, lanes);
  }
  granular::spread(pairs_.friction, batch, friction);
  Lane& before = batch.history[kRadiusSlot];
  for (std::size_t k = 0; k < batch.count; ++k) {
    const double a = lanes.contact_radius[k];
    shrinks[k] = a < before[k] ? a / before[k] : 1.0;
    before[k] = a;
  }
  granular::add_tangential_spring(batch, lanes, friction, &shrinks);
  rolling_.add(batch, lanes, has_necks() ? kNeckSlot + 1 : kNeckSlot);
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ContactLaw, scree::HertzMindlin>(
      "hertz_mindlin", "Elastic spheres after Hertz and Mindlin, with Coulomb friction and a restitution of any speed.",
      scree::HertzMindlin::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("hertz_mindlin", "1.0.0", &list)};
