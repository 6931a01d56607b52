#include "run.hpp"

#include <fmt/format.h>

#include "say.hpp"
#include "scree/interfaces/build_fingerprint.hpp"
#include "scree/model/body_store.hpp"
#include "scree/results/result_claims.hpp"

namespace scree {
namespace {

RunRecord describe(const Simulation& simulation, const RunOptions& options) {
  RunRecord record;
  record.scene_file = options.scene.string();
  record.scene_hash = simulation.scene_hash();
  record.resolved_scene = simulation.resolved_scene();
  record.scree_version = SCREE_VERSION;
  record.compiler = build_fingerprint().compiler;
  record.seed = simulation.seed();
  record.threads = options.threads;
  record.time_step = simulation.time_step();
  for (const PartInfo& part : simulation.parts()) {
    record.plugins.push_back({part.kind, part.type, part.version, part.library});
  }
  return record;
}

}  // namespace

Run::Run(Simulation& simulation, const RunOptions& options)
    : simulation_{simulation},
      options_{options},
      step_log_{options.output / kStepsFile, phase_names()},
      removed_log_{options.output / kRemovedFile, simulation.materials()},
      progress_{options.quiet, simulation.time(), simulation.end_time()},
      statistics_{!simulation.poses_contact_problems()},
      recording_{simulation, options.record_ccp, options.output, "--record-ccp"},
      last_checkpoint_{simulation.time()},
      record_{describe(simulation, options)} {
  if (!simulation.machine().empty()) joint_log_.emplace(options.output / kJointsFile);
}

int Run::to_the_end() {
  const InterruptWatch watch;
  try {
    tell_warnings();
    const bool had_nothing_to_do = simulation_.is_done();
    const bool done = steps_to_the_end(watch);
    const std::string outcome =
        had_nothing_to_do ? fmt::format(
                                "nothing to do: the checkpoint is at {:.6g} s, and the run ends at {:.6g} s; a later "
                                "--end-time continues it",
                                simulation_.time(), simulation_.end_time())
                          : fmt::format("{} at {:.6g} s", done ? "done" : "interrupted", simulation_.time());
    const int exit_code = done ? 0 : kInterrupted;
    finish(exit_code, outcome);
    print_end(outcome);
    return exit_code;
  } catch (const Error& failure) {
    progress_.end_line();
    const bool saved = finish_failed(failure);
    tell_warnings();
    tell_untold();
    if (!saved) throw;
    std::string where = fmt::format("{}; the last good state, at {:.6g} s, is in {}, without what contacts remember",
                                    failure.what(), simulation_.time(), (options_.output / kLastStateFile).string());
    if (has_checkpoint_) {
      where += fmt::format("; a whole checkpoint, at {:.6g} s, is in {}", last_checkpoint_,
                           (options_.output / kCheckpointFile).string());
    }
    throw Error{failure.kind(), where};
  }
}

bool Run::steps_to_the_end(const InterruptWatch& watch) {
  while (!simulation_.is_done()) {
    if (watch.interrupted()) return false;
    recording_.before_step(simulation_);
    const StepRecord step = simulation_.step();
    const PhaseTimer::Scope scope{simulation_.timer(), Phase::output};
    after_step(step);
  }
  return true;
}

void Run::after_step(const StepRecord& step) {
  statistics_.add(step);
  removed_log_.add(simulation_.removed());
  if (step.step % static_cast<std::uint64_t>(simulation_.steps_every()) == 0 || simulation_.is_done()) {
    step_log_.add(step, simulation_.timer().take());
    if (joint_log_) joint_log_->add(simulation_.machine(), simulation_.time());
  }
  const double interval = simulation_.checkpoint_interval();
  if (interval > 0.0 && simulation_.time() - last_checkpoint_ > interval - 0.5 * simulation_.time_step()) {
    save_checkpoint();
  }
  tell_warnings();
  progress_.update(progress_state(step));
}

void Run::tell_warnings() {
  for (const std::string& sentence : log_watch_.news(simulation_.log())) {
    progress_.end_line();
    warn(sentence);
  }
}

void Run::tell_untold() const {
  if (log_watch_.untold() == 0) return;
  warn(fmt::format("{} more in {}, under \"log\"", log_watch_.untold(), (options_.output / kRunFile).string()));
}

void Run::report_recording() const {
  for (const std::uint64_t step : recording_.steps()) {
    if (step > simulation_.steps()) continue;
    const std::string file = recording_.file(step).string();
    if (std::filesystem::exists(file)) {
      say("contact problem of step {}: {}\n", step, file);
    } else {
      say("step {} had no contacts: there is no contact problem to record\n", step);
    }
  }
}

void Run::save_checkpoint() {
  simulation_.save(options_.output / kCheckpointFile);
  last_checkpoint_ = simulation_.time();
  has_checkpoint_ = true;
}

void Run::finish(int exit_code, const std::string& outcome) {
  progress_.end_line();
  // Before the observers end: what continues from here finds them in the middle of their work.
  save_checkpoint();
  simulation_.finish();
  tell_warnings();
  step_log_.close();
  removed_log_.close();
  if (joint_log_) joint_log_->close();
  write_record(exit_code, outcome);
  tell_untold();
}

/// Saves what can be saved, and tells whether the last good state is. A second failure, on a full disk say, would only hide
/// the first. What a stepper keeps of contacts is lost with the step: a checkpoint that has it stays as it is.
bool Run::finish_failed(const Error& failure) {
  const auto attempt = [](const auto& call) {
    try {
      call();
      return true;
    } catch (const std::exception&) {
      return false;
    }
  };
  bool saved = false;
  if (failure.kind() == ErrorKind::diverged) {
    saved = attempt([&] { simulation_.save(options_.output / kLastStateFile); });
    attempt([&] { simulation_.finish(); });
  }
  attempt([&] { write_record(failure.exit_code(), failure.what()); });
  return saved;
}

void Run::write_record(int exit_code, const std::string& outcome) {
  record_.exit_status = exit_code;
  record_.outcome = outcome;
  record_.simulated_time = simulation_.time();
  record_.steps = simulation_.steps();
  record_.wall_time = wall_time();
  record_.bodies = simulation_.bodies().size();
  record_.contacts = statistics_.last().contacts;
  record_.state_hash = simulation_.state_hash();
  record_.measures = statistics_.measures();
  record_.log = simulation_.log();
  const std::vector<std::string> names = phase_names();
  for (std::size_t p = 0; p < names.size(); ++p) {
    record_.phase_seconds.emplace_back(names[p], simulation_.timer().total()[p]);
  }
  record_.tables = {balance_table(simulation_)};
  for (ReportTable& table : simulation_.report()) record_.tables.push_back(std::move(table));
  write_run_record(record_, options_.output / kRunFile);
}

void Run::print_end(const std::string& outcome) const {
  for (const ReportTable& table : record_.tables) say("\n{}", to_text(table));
  say("\n{}", to_text(work_table(statistics_, simulation_.timer())));
  if (options_.profile) say("\n{}", to_text(phase_table(simulation_.timer())));
  report_recording();
  std::string steps = fmt::format("{} steps", record_.steps);
  if (statistics_.is_soft()) steps += fmt::format(" of {:.4g} sub-steps", statistics_.mean_sub_steps());
  say("\n{}, {} in {}, state {}; results in {}\n", outcome, steps, duration_text(record_.wall_time),
      to_hex(record_.state_hash), options_.output.string());
}

double Run::wall_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

ProgressState Run::progress_state(const StepRecord& step) const {
  return {step.time,
          simulation_.end_time(),
          step.bodies,
          step.contacts,
          static_cast<int>(step.iterations),
          step.residual,
          wall_time(),
          !simulation_.poses_contact_problems()};
}

}  // namespace scree
