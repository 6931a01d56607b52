// run_to: a simulation without results, for commands that want its state or its cost.
#pragma once

#include <cstdint>
#include <functional>

namespace scree {

class Simulation;
struct StepRecord;

/// Steps `simulation` until `steps` are done, with progress unless `quiet`; either hook may be empty. False when an
/// interrupt ended it. @throws Error as Simulation::step() does.
bool run_to(Simulation& simulation, std::uint64_t steps, bool quiet, const std::function<void()>& before_step,
            const std::function<void(const StepRecord&)>& after_step);

}  // namespace scree
