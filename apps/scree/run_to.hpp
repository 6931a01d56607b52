// run_to: a simulation without results, for commands that want its state or its cost.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace scree {

class Simulation;
struct StepRecord;

/// Steps `simulation` until `steps` are done, with progress unless `quiet`; either hook may be empty. False when an
/// interrupt ended it. @throws Error as Simulation::step() does.
bool run_to(Simulation& simulation, std::uint64_t steps, bool quiet, const std::function<void()>& before_step,
            const std::function<void(const StepRecord&)>& after_step);

/// The step of `simulation`, not taken yet, that ends at `time` [s], half a step of slack. @throws Error (usage) that names
/// `option` when the run has none.
[[nodiscard]] std::uint64_t step_at(double time, const Simulation& simulation, const std::string& option);

}  // namespace scree
