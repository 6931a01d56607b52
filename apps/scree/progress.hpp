// What a run says about itself while it goes on.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace scree {

/// Where a run is.
struct ProgressState {
  double time = 0.0;      ///< simulated [s]
  double end_time = 0.0;  ///< [s]
  std::uint64_t bodies = 0;
  std::uint64_t contacts = 0;
  int iterations = 0;      ///< of the solver, last step; sub-steps where no contact problem is solved
  double residual = 0.0;   ///< of the solver, last step [m/s]
  double wall_time = 0.0;  ///< since the run began [s]
  bool is_soft = false;    ///< no contact problem is solved
};

/// One line: "1.250 of 5.000 s (25 %), 12034 bodies, 30211 contacts, 100 iterations, residual 3.1e-04 m/s, 0.021 x
/// real time, 3 min 2 s left"; of a run with soft contacts "45 sub-steps" in place of iterations and residual. `start_time` [s]
/// is where the run began, not 0 for a resumed one.
[[nodiscard]] std::string progress_line(const ProgressState& now, double start_time);

/// A duration for people: "45 s", "3 min 2 s", "2 h 5 min". `seconds` [s].
[[nodiscard]] std::string duration_text(double seconds);

/// Decides when a line is due in a pipe: every tenth of the run, and every ten seconds.
class ProgressPace {
 public:
  /// Times in [s] of simulated time.
  ProgressPace(double start_time, double end_time) : start_{start_time}, end_{end_time} {}
  /// True when a line is due at this simulated and wall time [s]; counts as printed then.
  bool due(double time, double wall_time);

 private:
  double start_;
  double end_;
  int tenth_ = 0;
  double printed_ = 0.0;  // wall time [s]
};

/// Prints progress: one line that is written over on a terminal, plain lines anywhere else, nothing when quiet.
class Progress {
 public:
  Progress(bool quiet, double start_time, double end_time);
  void update(const ProgressState& now);
  /// Leaves the line of a terminal, so that other text can follow.
  void end_line();

 private:
  bool quiet_;
  bool terminal_;
  double start_;
  double shown_ = -1.0;  // wall time of the last line on a terminal [s]
  bool open_ = false;    // a terminal's line waits for its end
  ProgressPace pace_;
};

}  // namespace scree
