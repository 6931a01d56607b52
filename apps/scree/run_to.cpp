#include "run_to.hpp"

#include <fmt/format.h>

#include <cmath>

#include <chrono>

#include "interrupt.hpp"
#include "log_watch.hpp"
#include "progress.hpp"
#include "say.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {

bool run_to(Simulation& simulation, std::uint64_t steps, bool quiet, const std::function<void()>& before_step,
            const std::function<void(const StepRecord&)>& after_step) {
  const InterruptWatch watch;
  const auto start = std::chrono::steady_clock::now();
  const double end = static_cast<double>(steps) * simulation.time_step();
  Progress progress{quiet, simulation.time(), end};
  LogWatch log_watch{simulation.steps() == 0 ? 0 : simulation.log().size()};
  const auto tell_warnings = [&] {
    for (const std::string& sentence : log_watch.news(simulation.log())) {
      progress.end_line();
      warn(sentence);
    }
  };
  tell_warnings();
  while (simulation.steps() < steps && !watch.interrupted()) {
    if (before_step) before_step();
    const StepRecord step = simulation.step();
    if (after_step) after_step(step);
    tell_warnings();
    progress.update({step.time, end, step.bodies, step.contacts, static_cast<int>(step.iterations), step.residual,
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                     !simulation.poses_contact_problems()});
  }
  progress.end_line();
  if (log_watch.untold() > 0) warn(fmt::format("{} more", log_watch.untold()));
  return simulation.steps() >= steps;
}

std::uint64_t step_at(double time, const Simulation& simulation, const std::string& option) {
  const double h = simulation.time_step();
  if (time > simulation.end_time() + 0.5 * h || time < simulation.time() + 0.5 * h) {
    throw Error{
        ErrorKind::usage,
        {option, 0, 0},
        fmt::format("there is no step at {:.6g} s: this run goes from {:.6g} s to {:.6g} s in steps of {:.6g} s", time,
                    simulation.time(), simulation.end_time(), h)};
  }
  return static_cast<std::uint64_t>(std::llround(time / h));
}

}  // namespace scree
