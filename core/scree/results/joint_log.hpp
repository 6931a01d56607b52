// JointLog: joints.csv of a run, one row a joint, motor and coupling.
#pragma once

#include <filesystem>

#include "scree/machine/machine.hpp"
#include "scree/results/csv.hpp"

namespace scree {

/// Writes joints.csv: coordinates and their rates, the reaction on b (that on a is its opposite), the effort of motors and
/// springs, power and energy given to the bodies, the error of the equations.
class JointLog {
 public:
  /// @throws Error (io).
  explicit JointLog(const std::filesystem::path& file);
  /// The machine at the end of a step, `time` [s].
  void add(const Machine& machine, double time);
  void close() { table_.close(); }

 private:
  void add_row(double time, std::string_view name, std::string_view kind, const MachineReport& report);
  CsvWriter table_;
};

}  // namespace scree
