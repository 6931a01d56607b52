#include "ccp_recording.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "run_to.hpp"
#include "scree/base/error.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/interfaces/time_stepper.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {

void check_poses_problems(const Simulation& simulation, const std::string& option) {
  if (simulation.poses_contact_problems()) return;
  const std::vector<PartInfo> parts = simulation.parts();
  const auto find = [&](const char* kind) { return std::ranges::find(parts, kind, &PartInfo::kind); };
  std::string sentence =
      find(TimeStepper::kKind)->label() +
      " poses no contact problem; take a stepper that does, such as dvi (--set time_stepper.type=dvi)";
  if (find(CcpSolver::kKind) == parts.end()) sentence += ", and give the scene a [ccp_solver]";
  throw Error{ErrorKind::usage, {option, 0, 0}, sentence};
}

CcpRecording::CcpRecording(const Simulation& simulation, const std::vector<double>& times, std::filesystem::path folder,
                           const std::string& option)
    : folder_{std::move(folder)} {
  if (!times.empty()) check_poses_problems(simulation, option);
  for (const double time : times) steps_.insert(step_at(time, simulation, option));
}

void CcpRecording::before_step(Simulation& simulation) const {
  const std::uint64_t next = simulation.steps() + 1;
  if (steps_.contains(next)) simulation.record_problem(file(next));
}

std::filesystem::path CcpRecording::file(std::uint64_t step) const { return folder_ / fmt::format("ccp_{}.h5", step); }

}  // namespace scree
