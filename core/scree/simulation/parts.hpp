// Parts: all plugins of a simulation, made from the sections of the scene.
#pragma once

#include <optional>
#include <vector>

#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "scree/interfaces/electric_field.hpp"
#include "scree/interfaces/force_field.hpp"
#include "scree/interfaces/narrow_phase.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/sink.hpp"
#include "scree/interfaces/source.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "scree/simulation/part.hpp"

namespace scree {

class SceneDocument;

/// The plugins of one simulation, in scene order.
struct Parts {
  Part<TimeStepper> stepper;
  std::optional<Part<CcpSolver>> solver;
  double solver_tolerance = 0.0;  ///< ccp_residual [m/s]
  int solver_iterations = 0;
  bool active_set = true;  ///< solve by the contacts that matter (scree/ccp/active_set.hpp)
  std::optional<Part<ContactLaw>> law;
  Part<BroadPhase> broad;
  std::vector<Part<NarrowPhase>> narrow;
  std::vector<Part<ElectricField>> electric;
  std::vector<Part<ForceField>> forces;
  std::vector<Part<Source>> sources;
  std::vector<Part<Sink>> sinks;
  std::vector<Part<Observer>> observers;

  /// Calls `visit(PartInfo, Options, Plugin&)` for every part, in a fixed order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    const auto one = [&](const auto& part) { visit(part.info, part.options, static_cast<Plugin&>(*part.plugin)); };
    one(stepper);
    if (solver) one(*solver);
    if (law) one(*law);
    one(broad);
    const auto all = [&](const auto& parts) {
      for (const auto& part : parts) one(part);
    };
    all(narrow);
    all(electric);
    all(forces);
    all(sources);
    all(sinks);
    all(observers);
  }
};

/// Makes every part that the scene names. @throws Error (usage) for an unknown plugin, bad options, a name used twice,
/// or a section that has to be there and is not.
[[nodiscard]] Parts make_parts(const SceneDocument& document, const PluginCatalog& catalog);

}  // namespace scree
