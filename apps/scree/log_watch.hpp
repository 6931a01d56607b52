// LogWatch: the warnings that parts log while a run goes on, for the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scree {

/// Finds warnings among the lines of a log that grows: lines that begin with "warning: ", or have it behind the name of the
/// part, "time_stepper:dem: warning: ...". Each is told once, so many of them at most; the log has them all.
class LogWatch {
 public:
  static constexpr std::size_t kMost = 20;

  /// Leaves out the first `seen` lines.
  explicit LogWatch(std::size_t seen = 0) : seen_{seen} {}

  /// The warnings that came to `log` since the last call, without the word.
  [[nodiscard]] std::vector<std::string> news(const std::vector<std::string>& log);
  /// Warnings that were too many to be told.
  [[nodiscard]] std::size_t untold() const { return untold_; }

 private:
  std::size_t seen_;               // lines of the log
  std::vector<std::string> told_;  // warnings
  std::size_t untold_ = 0;
};

}  // namespace scree
