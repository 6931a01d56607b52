// Simulation: a scene that runs.
//
// The way of one step:
//
//     sources add bodies -> time stepper (forces, collision, contact problem, positions) -> fields advance their state
//     -> observers look -> sinks remove
//
// A body that a sink takes is still seen by the observers in that step, and listed as removed in the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scree/interfaces/observer.hpp"
#include "scree/results/step_log.hpp"
#include "scree/simulation/feed_record.hpp"
#include "scree/simulation/part.hpp"
#include "scree/simulation/phase_timer.hpp"

namespace scree {

class BodyStore;
class CollisionFilter;
class Machine;
class Materials;
class PluginCatalog;
class SceneDocument;
class ShapeSet;

/// What a run is asked for beside the scene.
struct SimulationSettings {
  int threads = 1;
  std::optional<double> end_time;  ///< instead of the scene's [s]
  std::filesystem::path results;   ///< folder that observers write into; empty for none
};

/// A scene with its parts, its bodies and its time.
class Simulation {
 public:
  /// Reads the scene, makes and sets up every part, and adds the bodies of the scene.
  /// @throws Error (usage, io) with the place in the scene.
  Simulation(const SceneDocument& document, const PluginCatalog& catalog, const SimulationSettings& settings);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Advances by one outer step. @throws Error (diverged) naming the cause; save() then writes the state before the step.
  StepRecord step();
  /// Finds what a run would refuse in its first step and setup cannot know: where contacts are soft, sources add the bodies of
  /// that step and the time stepper takes it; fields, observers and sinks do not hear of it. Called once, in place of
  /// step(). @throws Error as step() does.
  void try_first_step();
  /// Ends the run: observers write what is left. Called once.
  void finish();

  [[nodiscard]] double time() const;       ///< [s]
  [[nodiscard]] double end_time() const;   ///< [s]
  [[nodiscard]] double time_step() const;  ///< [s]
  [[nodiscard]] std::uint64_t steps() const;
  /// True after the first step that ends at or after end_time(), to a billionth of a step.
  [[nodiscard]] bool is_done() const;
  [[nodiscard]] std::uint64_t state_hash() const;
  [[nodiscard]] const BodyStore& bodies() const;
  [[nodiscard]] const Materials& materials() const;
  [[nodiscard]] const ShapeSet& shapes() const;
  /// Who meets whom.
  [[nodiscard]] const CollisionFilter& collision_filter() const;
  /// True when steps solve contact problems, false when their contacts are soft.
  [[nodiscard]] bool poses_contact_problems() const;
  /// Joints and motors; empty without.
  [[nodiscard]] const Machine& machine() const;
  [[nodiscard]] const FeedRecord& feed() const;
  [[nodiscard]] PhaseTimer& timer();
  /// Bodies taken out in the last step.
  [[nodiscard]] const std::vector<RemovedBody>& removed() const;
  /// Tables of the sources and observers, after finish().
  [[nodiscard]] std::vector<ReportTable> report() const;

  /// Steps between rows of steps.csv, and simulated time between checkpoints [s], 0 for none.
  [[nodiscard]] std::int64_t steps_every() const;
  [[nodiscard]] double checkpoint_interval() const;
  /// All parts, for run.json.
  [[nodiscard]] std::vector<PartInfo> parts() const;
  /// Lines that parts logged, most of them at setup.
  [[nodiscard]] const std::vector<std::string>& log() const;
  /// What looks like a mistake of the scene, but does not keep it from running. Also in log().
  [[nodiscard]] const std::vector<std::string>& warnings() const;
  /// The scene with every default filled in, as JSON.
  [[nodiscard]] std::string resolved_scene() const;
  /// A hash of what decides the motion: the resolved scene without end time, output and observers.
  [[nodiscard]] std::string scene_hash() const;
  [[nodiscard]] std::uint64_t seed() const;

  /// Puts the contact problem of the next step into `file`, as the time stepper poses it, with its guess
  /// (scree/ccp/ccp_file.hpp). A step that solves several, for exact Coulomb friction, gives its first; one without
  /// contacts gives none. @throws Error (usage) when the scene has no contact solver.
  void record_problem(const std::filesystem::path& file);
  /// Writes a checkpoint. @throws Error (io).
  void save(const std::filesystem::path& file) const;
  /// Continues from a checkpoint of the same scene. @throws Error (io, usage).
  void resume(const std::filesystem::path& file);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scree
