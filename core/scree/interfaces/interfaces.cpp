// The out-of-line members of the interfaces: their destructors anchor the type information in libscree, so that a part
// made in a plugin is recognised by the host, and the defaults of optional calls stand in one place.
#include <stdexcept>

#include "scree/interfaces/broad_phase.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/interfaces/contact_law.hpp"
#include "scree/interfaces/contact_reader.hpp"
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
void Plugin::save(StateWriter&) const {}
void Plugin::load(const StateReader&) {}
void Plugin::release_workspace() {}

BroadPhase::~BroadPhase() = default;

CcpSolver::~CcpSolver() = default;

ContactLaw::~ContactLaw() = default;
void ContactLaw::setup(SceneServices&) {}

ContactReader::~ContactReader() = default;

ElectricField::~ElectricField() = default;
void ElectricField::setup(SceneServices&) {}

ForceField::~ForceField() = default;
void ForceField::setup(SceneServices&) {}
double ForceField::potential_energy(const BodyView&, double) const { return 0.0; }
void ForceField::advance(const BodyView&, const ContactView&, Attributes&, double, double) {}

NarrowPhase::~NarrowPhase() = default;
void NarrowPhase::bind(const ShapeSet&, std::size_t) {}

Observer::~Observer() = default;
void Observer::setup(SceneServices&, const std::filesystem::path&) {}
void Observer::finish(const Observation&) {}
std::vector<ReportTable> Observer::report() const { return {}; }

std::string SceneServices::part_name() const { return {}; }
std::vector<std::string> SceneServices::body_names() const { return {}; }

Sink::~Sink() = default;
void Sink::setup(SceneServices&) {}

Source::~Source() = default;
std::vector<ReportTable> Source::report() const { return {}; }
void Source::setup(SceneServices&) {}

StepServices::~StepServices() = default;
NeighbourView StepServices::neighbours(const BodyView&, const ExpectedMotion&) {
  throw std::logic_error{"this host finds no neighbours"};
}
std::span<const Contact> StepServices::neighbour_contacts(const BodyView&, double) {
  throw std::logic_error{"this host finds no neighbours"};
}
std::span<const Contact> StepServices::wall_contacts(const BodyView&, std::span<const BodyIndex>, std::span<const Vec3>,
                                                     std::span<const Vec3>, double) {
  return {};
}

TimeStepper::~TimeStepper() = default;
void TimeStepper::setup(SceneServices&) {}

SceneServices::~SceneServices() = default;
void SceneServices::show_all_attributes() {}
PluginCatalog::~PluginCatalog() = default;

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
