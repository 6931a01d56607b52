// What a Simulation is made of; private to core/simulation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scree/collision/collision_pipeline.hpp"
#include "scree/machine/machine.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/simulation/birth_check.hpp"
#include "scree/simulation/parts.hpp"
#include "scree/simulation/scene_model.hpp"
#include "scree/simulation/setup_services.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/step_backup.hpp"
#include "scree/simulation/step_host.hpp"

namespace scree {

struct Simulation::State {
  State(const SceneDocument& document, const PluginCatalog& catalog, const SimulationSettings& wanted);

  SimulationSettings settings;
  Executor executor;
  SceneModel model;
  Parts parts;
  std::vector<CollisionGroup> source_groups;  // by source
  BodyStore bodies;
  PrescribedMotions motions{model.motions};
  std::vector<std::string> log;
  std::vector<std::string> warnings;
  std::optional<SetupServices> services;
  std::optional<CollisionPipeline> pipeline;
  std::optional<Machine> machine;
  std::vector<char> parted;  // by joint: gone, and its bodies meet again
  PhaseTimer timer;
  BirthCheck births;
  std::optional<StepHost> host;

  double time_step = 0.0;  // [s]
  double end_time = 0.0;   // [s]
  double max_speed = 0.0;  // [m/s]
  std::uint64_t steps = 0;
  std::uint64_t last_step = 0;  // steps after which the run is done
  bool fed_this_step = false;   // sources of the current step have emitted
  std::uint64_t fallbacks = 0;  // of the narrow phases, up to the last step
  bool failed = false;          // the last step threw; bodies are those before it
  FeedRecord feed;
  EnergyAccount energy;  // up to the last step; energies of the moment are zero
  std::vector<RemovedBody> removed;
  std::vector<NewBody> born;
  std::vector<char> leaving;
  StepBackup backup;

  [[nodiscard]] double time() const { return static_cast<double>(steps) * time_step; }
  [[nodiscard]] Observation observation(std::uint64_t step) const;

  void count_steps();
  void tell_of_shapes();
  void setup_parts();
  void add_scene_bodies();
  void add(NewBody body);
  void check_overlap();
  void feed_sources();
  StepSummary take_step();
  StepSummary advance();
  void check_motion() const;
  void advance_fields(double end);
  void observe();
  void remove_bodies(double at);
  [[nodiscard]] StepRecord record(const StepSummary& summary);
  void restore_from(const StateReader& in);
  void save_to(StateWriter& out) const;
};

}  // namespace scree
