#include "drag.hpp"

#include <functional>
#include <numbers>
#include <sstream>

#include "scree/base/require.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/parallel/executor.hpp"

namespace scree {
namespace {

constexpr std::size_t kChunk = 2048;             // bodies of one task: about 0.1 ms
constexpr double kNewtonReynolds = 1000.0;       // beyond it the drag coefficient is constant
constexpr double kNewtonDragCoefficient = 0.44;  // Newton's regime

}  // namespace

Drag::Drag(const Options& options)
    : stokes_{options.text("law") == "stokes"},
      viscosity_{options.number("viscosity")},
      density_{options.number("density")},
      wind_{options.vector("wind")} {}

std::vector<Parameter> Drag::parameters() {
  return {
      Parameter::choice("law", {"stokes", "schiller_naumann"}, "drag coefficient: creeping flow, or up to turbulence")
          .by_default("schiller_naumann"),
      Parameter::number("viscosity", "Pa s", "dynamic viscosity of the gas; default: air")
          .above(0.0)
          .by_default(1.81e-5),
      Parameter::number("density", "kg/m3", "density of the gas; default: air").at_least(0.0).by_default(1.225),
      Parameter::vector("wind", "m/s", "velocity of the gas, the same everywhere, in the world").by_default(Vec3{}),
  };
}

void Drag::setup(SceneServices& services) {
  executor_ = &services.executor();
  // Stokes' law is the weakest drag of both, so this is a lower bound for schiller_naumann.
  std::ostringstream line;
  line << "in a step of " << services.time_step() << " s, grains whose density times radius squared is above "
       << 4.5 * viscosity_ * services.time_step() << " kg/m slow down without overshoot (Stokes' law)";
  services.log(line.str());
}

void Drag::add_forces(const BodyView& bodies, double, WrenchView out) const {
  SCREE_REQUIRE(executor_ != nullptr, "drag: setup() comes before add_forces()");
  const auto chunk = [&](std::size_t first, std::size_t last) {
    stokes_ ? add_stokes(bodies, first, last, out) : add_schiller_naumann(bodies, first, last, out);
  };
  executor_->for_chunks(bodies.size(), kChunk, std::cref(chunk));
}

void Drag::add_stokes(const BodyView& bodies, std::size_t first, std::size_t last, WrenchView out) const {
  const double factor = 6.0 * std::numbers::pi * viscosity_;
  for (std::size_t i = first; i < last; ++i) {
    if (bodies.motion[i] == Motion::dynamic) out.force[i] -= factor * bodies.radius[i] * (bodies.velocity[i] - wind_);
  }
}

void Drag::add_schiller_naumann(const BodyView& bodies, std::size_t first, std::size_t last, WrenchView out) const {
  constexpr double kPi = std::numbers::pi;
  for (std::size_t i = first; i < last; ++i) {
    if (bodies.motion[i] != Motion::dynamic) continue;
    const Vec3 relative = bodies.velocity[i] - wind_;
    const double speed = norm(relative);
    const double r = bodies.radius[i];
    const double reynolds = density_ * speed * 2.0 * r / viscosity_;
    const double factor = reynolds < kNewtonReynolds
                              ? 6.0 * kPi * viscosity_ * r * (1.0 + 0.15 * std::pow(reynolds, 0.687))
                              : 0.5 * kNewtonDragCoefficient * density_ * kPi * r * r * speed;
    out.force[i] -= factor * relative;
  }
}

}  // namespace scree

namespace {

void list(scree::PluginList& plugins) {
  plugins.add<scree::ForceField, scree::Drag>("drag", "Resistance of a gas, with a uniform wind.",
                                              scree::Drag::parameters());
}

}  // namespace

extern "C" SCREE_EXPORT const scree::PluginLibrary scree_plugin_library{
    scree::describe_library("drag", "1.0.0", &list)};
