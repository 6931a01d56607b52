#include "progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include "say.hpp"

namespace scree {
namespace {

constexpr double kTerminalInterval = 0.2;  // between two lines on a terminal [s]
constexpr double kPipeInterval = 10.0;     // between two lines in a pipe, at most [s]

double share_done(double time, double start, double end) {
  return end > start ? std::clamp((time - start) / (end - start), 0.0, 1.0) : 1.0;
}

/// Characters that fit into a line of the terminal; a longer line would wrap and could not be written over.
std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return 79;
  return size.ws_col - 1u;
}

}  // namespace

std::string duration_text(double seconds) {
  const auto total = static_cast<long long>(std::llround(std::clamp(seconds, 0.0, 1e12)));
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {} s", total / 60, total % 60);
  return fmt::format("{} h {} min", total / 3600, total % 3600 / 60);
}

std::string progress_line(const ProgressState& now, double start_time) {
  const double done = share_done(now.time, start_time, now.end_time);
  std::string line = fmt::format("{:.4g} of {:.4g} s ({:.0f} %), {}, {}", now.time, now.end_time, 100.0 * done,
                                 counted(now.bodies, "body", "bodies"), counted(now.contacts, "contact", "contacts"));
  const auto iterations = static_cast<std::size_t>(now.iterations);
  line += now.is_soft
              ? ", " + counted(iterations, "sub-step", "sub-steps")
              : fmt::format(", {}, residual {:.1e} m/s", counted(iterations, "iteration", "iterations"), now.residual);
  if (done <= 0.0 || now.wall_time <= 0.0) return line;
  line += fmt::format(", {:.2g} x real time, {} left", (now.time - start_time) / now.wall_time,
                      duration_text(now.wall_time * (1.0 - done) / done));
  return line;
}

bool ProgressPace::due(double time, double wall_time) {
  // A little more than rounding, so that 0.1 + 0.1 + 0.1 is three tenths.
  const int tenth = static_cast<int>(10.0 * share_done(time, start_, end_) + 1e-9);
  if (tenth <= tenth_ && wall_time - printed_ < kPipeInterval) return false;
  tenth_ = std::max(tenth, tenth_);
  printed_ = wall_time;
  return true;
}

Progress::Progress(bool quiet, double start_time, double end_time)
    : quiet_{quiet}, terminal_{isatty(STDOUT_FILENO) != 0}, start_{start_time}, pace_{start_time, end_time} {}

void Progress::update(const ProgressState& now) {
  if (quiet_) return;
  if (terminal_) {
    const bool last = now.time >= now.end_time;
    if (!last && shown_ >= 0.0 && now.wall_time - shown_ < kTerminalInterval) return;
    shown_ = now.wall_time;
    open_ = true;
    say("\r\x1b[K{:.{}}", progress_line(now, start_), terminal_width());
  } else {
    if (!pace_.due(now.time, now.wall_time)) return;
    say("{}\n", progress_line(now, start_));
  }
  std::fflush(stdout);
}

void Progress::end_line() {
  if (open_) say("\n");
  open_ = false;
}

}  // namespace scree
