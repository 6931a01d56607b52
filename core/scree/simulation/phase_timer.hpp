// PhaseTimer: wall time by phase of a step.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace scree {

/// The phases that a step's wall time is divided into.
enum class Phase : std::size_t { sources, forces, collision, solver, stepper, fields, observers, sinks, output };
inline constexpr std::size_t kPhaseCount = 9;

/// Names of the phases, in order.
[[nodiscard]] inline std::vector<std::string> phase_names() {
  return {"sources", "forces", "collision", "solver", "stepper", "fields", "observers", "sinks", "output"};
}

/// Seconds by phase. Phases nest: the time of an inner one is not counted for the outer one.
class PhaseTimer {
 public:
  using Seconds = std::array<double, kPhaseCount>;

  /// Times a scope.
  class Scope {
   public:
    Scope(PhaseTimer& timer, Phase phase)
        : timer_{timer}, phase_{phase}, nested_before_{timer.nested_}, start_{Clock::now()} {
      timer_.nested_ = 0.0;
    }
    ~Scope() {
      const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
      timer_.total_[static_cast<std::size_t>(phase_)] += elapsed - timer_.nested_;
      timer_.nested_ = nested_before_ + elapsed;
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PhaseTimer& timer_;
    Phase phase_;
    double nested_before_;  // [s]
    std::chrono::steady_clock::time_point start_;
  };

  [[nodiscard]] const Seconds& total() const { return total_; }
  /// Seconds since the last call of take(), by phase.
  [[nodiscard]] Seconds take() {
    Seconds since{};
    for (std::size_t p = 0; p < kPhaseCount; ++p) since[p] = total_[p] - taken_[p];
    taken_ = total_;
    return since;
  }

 private:
  using Clock = std::chrono::steady_clock;
  double nested_ = 0.0;  // seconds of the scopes that ended inside the current one
  Seconds total_{};
  Seconds taken_{};
};

}  // namespace scree
