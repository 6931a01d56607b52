// What the interfaces do when a part does not override them. Their destructors live here, so that every interface has
// one type description, in libscree, that plugins share.
#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/interfaces/electric_field.hpp"
#include "scree/interfaces/force_field.hpp"
#include "scree/interfaces/narrow_phase.hpp"
#include "scree/interfaces/observer.hpp"
#include "scree/interfaces/plugin_library.hpp"
#include "scree/interfaces/scene_services.hpp"
#include "scree/interfaces/sink.hpp"
#include "scree/interfaces/source.hpp"
#include "scree/interfaces/time_stepper.hpp"

namespace scree {

Plugin::~Plugin() = default;
void Plugin::save(StateWriter& /*out*/) const {}
void Plugin::load(const StateReader& /*in*/) {}

PluginCatalog::~PluginCatalog() = default;
SceneServices::~SceneServices() = default;
StepServices::~StepServices() = default;

ForceField::~ForceField() = default;
void ForceField::setup(SceneServices& /*services*/) {}
double ForceField::potential_energy(const BodyView& /*bodies*/, double /*time*/) const { return 0.0; }
void ForceField::advance(const BodyView& /*bodies*/, const ContactView& /*contacts*/, Attributes& /*attributes*/,
                         double /*time*/, double /*dt*/) {}

ElectricField::~ElectricField() = default;
void ElectricField::setup(SceneServices& /*services*/) {}

BroadPhase::~BroadPhase() = default;

NarrowPhase::~NarrowPhase() = default;
void NarrowPhase::bind(const ShapeSet& /*shapes*/, std::size_t /*first_new_primitive*/) {}

CcpSolver::~CcpSolver() = default;

TimeStepper::~TimeStepper() = default;
void TimeStepper::setup(SceneServices& /*services*/) {}

Source::~Source() = default;
void Source::setup(SceneServices& /*services*/) {}

Sink::~Sink() = default;
void Sink::setup(SceneServices& /*services*/) {}

Observer::~Observer() = default;
void Observer::setup(SceneServices& /*services*/, const std::filesystem::path& /*results*/) {}
void Observer::finish(const Observation& /*last*/) {}
std::vector<ReportTable> Observer::report() const { return {}; }

std::string_view to_string(SolveStatus status) {
  switch (status) {
    case SolveStatus::converged:
      return "converged";
    case SolveStatus::iteration_limit:
      return "iteration_limit";
    case SolveStatus::stalled:
      return "stalled";
    case SolveStatus::infeasible:
      return "infeasible";
    case SolveStatus::numerical_failure:
      return "numerical_failure";
  }
  return "unknown";
}

}  // namespace scree
