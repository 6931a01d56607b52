// CcpRecording: which steps of a run leave their contact problem as a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace scree {

class Simulation;

/// Refuses a scene whose steps pose no contact problems that could be recorded. @throws Error (usage) that names `option`.
void check_poses_problems(const Simulation& simulation, const std::string& option);

/// The contact problems that a run was asked for: of the steps that end nearest to given times.
class CcpRecording {
 public:
  /// `times` [s]; files go into `folder`. @throws Error (usage) that names `option` for a time that this run does not
  /// reach, or has already passed, and for a time stepper that poses no contact problems.
  CcpRecording(const Simulation& simulation, const std::vector<double>& times, std::filesystem::path folder,
               const std::string& option);

  /// To be called before every step: arranges for the problem when it is wanted.
  void before_step(Simulation& simulation) const;
  /// Steps that were asked for, as steps.csv counts them.
  [[nodiscard]] const std::set<std::uint64_t>& steps() const { return steps_; }
  /// ccp_<step>.h5 in the folder. It is missing after a step without contacts.
  [[nodiscard]] std::filesystem::path file(std::uint64_t step) const;

 private:
  std::set<std::uint64_t> steps_;
  std::filesystem::path folder_;
};

}  // namespace scree
