#include "ccp_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  const double h = simulation.time_step();
  for (const double time : times) {
    // Half a step of slack, as at the end of a run.
    if (time > simulation.end_time() + 0.5 * h || time < simulation.time() + 0.5 * h) {
      throw usage(option, fmt::format("there is no step at {:.6g} s: this run goes from {:.6g} s to {:.6g} s in steps "
                                      "of {:.6g} s",
                                      time, simulation.time(), simulation.end_time(), h));
    }
    steps_.insert(static_cast<std::uint64_t>(std::llround(time / h)));
  }
}

void CcpRecording::before_step(Simulation& simulation) const {
  const std::uint64_t next = simulation.steps() + 1;
  if (steps_.contains(next)) simulation.record_problem(file(next));
}

std::filesystem::path CcpRecording::file(std::uint64_t step) const { return folder_ / fmt::format("ccp_{}.h5", step); }

}  // namespace scree
