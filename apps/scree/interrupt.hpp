// Ctrl-C and SIGTERM: a run ends after the step that it is in, instead of in the middle of it.
#pragma once

namespace scree {

/// While one of these lives, the first SIGINT or SIGTERM is only noted; the second ends the program at once.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// True once a signal came.
  [[nodiscard]] bool interrupted() const;
};

/// The exit code of an interrupted run: 128 + SIGINT, as shells have it.
inline constexpr int kInterrupted = 130;

}  // namespace scree
