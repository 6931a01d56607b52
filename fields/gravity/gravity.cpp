#include "gravity.hpp"

#include "scree/interfaces/plugin_library.hpp"

namespace scree {

Gravity::Gravity(const Options& options) : acceleration_{options.vector("acceleration")} {}

std::vector<Parameter> Gravity::parameters() {
  return {Parameter::vector("acceleration", "m/s2", "acceleration of free fall, in the world")
              .by_default(Vec3{0.0, 0.0, -9.81})};
}

void Gravity::add_forces(const BodyView& bodies, double, WrenchView out) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    // The mass of an immovable body is infinite; infinity times a zero component would be NaN.
    if (bodies.motion[i] == Motion::dynamic) out.force[i] += bodies.mass[i] * acceleration_;
  }
}

double Gravity::potential_energy(const BodyView& bodies, double) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.motion[i] == Motion::dynamic) energy -= bodies.mass[i] * dot(acceleration_, bodies.position[i]);
  }
  return energy;
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ForceField, scree::Gravity>("gravity", "The same acceleration for every body.",
                                                 scree::Gravity::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("gravity", "1.0.0", &list)};
