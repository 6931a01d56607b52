#include "ccp_recording.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "run_to.hpp"
#include "scree/base/error.hpp"
#include "scree/interfaces/ccp_solver.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {
namespace {

Error usage(const std::string& option, const std::string& sentence) {
  return Error{ErrorKind::usage, {option, 0, 0}, sentence};
}

}  // namespace

CcpRecording::CcpRecording(const Simulation& simulation, const std::vector<double>& times, std::filesystem::path folder,
                           const std::string& option)
    : folder_{std::move(folder)} {
  const std::vector<PartInfo> parts = simulation.parts();
  const auto is_solver = [](const PartInfo& part) { return part.kind == CcpSolver::kKind; };
  if (!times.empty() && std::none_of(parts.begin(), parts.end(), is_solver)) {
    throw usage(option, "the scene has no [ccp_solver] and poses no contact problem");
  }
  for (const double time : times) steps_.insert(step_at(time, simulation, option));
}

void CcpRecording::before_step(Simulation& simulation) const {
  const std::uint64_t next = simulation.steps() + 1;
  if (steps_.contains(next)) simulation.record_problem(file(next));
}

std::filesystem::path CcpRecording::file(std::uint64_t step) const { return folder_ / fmt::format("ccp_{}.h5", step); }

}  // namespace scree
