// What a Simulation is made of; private to core/simulation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scree/collision/collision_pipeline.hpp"
#include "scree/parallel/executor.hpp"
#include "scree/simulation/parts.hpp"
#include "scree/simulation/scene_model.hpp"
#include "scree/simulation/setup_services.hpp"
#include "scree/simulation/simulation.hpp"
#include "scree/simulation/step_host.hpp"

namespace scree {

/// Poses and velocities at the beginning of a step, so that a step that fails can be undone.
struct MotionBackup {
  std::vector<Vec3> position;          // [m]
  std::vector<Quat> orientation;       // [1]
  std::vector<Vec3> velocity;          // [m/s]
  std::vector<Vec3> angular_velocity;  // [rad/s]

  void keep(const BodyView& bodies);
  void restore(const BodyState& bodies) const;
};

struct Simulation::State {
  State(const SceneDocument& document, const PluginCatalog& catalog, const SimulationSettings& wanted);

  SimulationSettings settings;
  Executor executor;
  SceneModel model;
  Parts parts;
  BodyStore bodies;
  std::vector<std::string> log;
  std::optional<SetupServices> services;
  std::optional<CollisionPipeline> pipeline;
  PhaseTimer timer;
  std::optional<StepHost> host;

  double time_step = 0.0;  // [s]
  double end_time = 0.0;   // [s]
  double max_speed = 0.0;  // [m/s]
  std::uint64_t steps = 0;
  bool fed_this_step = false;  // sources of the current step have emitted
  bool failed = false;         // the last step threw; bodies are those before it
  FeedRecord feed;
  std::vector<RemovedBody> removed;
  std::vector<NewBody> born;
  std::vector<char> leaving;
  MotionBackup backup;

  [[nodiscard]] double time() const { return static_cast<double>(steps) * time_step; }
  [[nodiscard]] Observation observation(double at) const;

  void setup_parts();
  void add_scene_bodies();
  void add(NewBody body);
  void check_overlap();
  void feed_sources();
  StepSummary advance();
  void check_motion() const;
  void remove_bodies(double at);
  void restore_from(const StateReader& in);
  void save_to(StateWriter& out) const;
};

}  // namespace scree
