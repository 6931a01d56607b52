// Run: a simulation from where it stands to its end, with progress, logs, checkpoints and run.json.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "ccp_recording.hpp"
#include "interrupt.hpp"
#include "log_watch.hpp"
#include "progress.hpp"
#include "run_options.hpp"
#include "run_statistics.hpp"
#include "scree/results/joint_log.hpp"
#include "scree/results/run_record.hpp"
#include "scree/results/step_log.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {

/// One run of a simulation into its result folder.
class Run {
 public:
  /// @throws Error (io) when the logs cannot be created, (usage) when problems are to be kept of steps that do not come.
  Run(Simulation& simulation, const RunOptions& options);

  /// Steps until the end or an interrupt, writes everything that is left, prints the tables. Returns the exit code, 0
  /// or kInterrupted.
  /// @throws Error when the run failed: run.json is written with the exit code of that error, and for a run that
  /// diverged the last good state as last_good_state.h5.
  int to_the_end();

 private:
  bool steps_to_the_end(const InterruptWatch& watch);
  void after_step(const StepRecord& step);
  void tell_warnings();
  void tell_untold() const;
  void save_checkpoint();
  void report_recording() const;
  void finish(int exit_code, const std::string& outcome);
  bool finish_failed(const Error& failure);
  void write_record(int exit_code, const std::string& outcome);
  void print_end(const std::string& outcome) const;
  [[nodiscard]] double wall_time() const;  // [s]
  [[nodiscard]] ProgressState progress_state(const StepRecord& step) const;

  Simulation& simulation_;
  const RunOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  StepLog step_log_;
  RemovedLog removed_log_;
  std::optional<JointLog> joint_log_;  // of scenes with joints
  Progress progress_;
  LogWatch log_watch_;
  RunStatistics statistics_;
  CcpRecording recording_;
  double last_checkpoint_;       // simulated time [s]
  bool has_checkpoint_ = false;  // of this run
  RunRecord record_;
};

}  // namespace scree
