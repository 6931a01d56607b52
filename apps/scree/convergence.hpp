// How solvers approach the solution: residuals by iteration and by time, as a table and as plots.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scree/results/csv.hpp"
#include "solver_trial.hpp"

namespace scree {

/// "cold" or "warm".
[[nodiscard]] std::string start_name(const SolverTrial& trial);

/// Wall time over iterations [s], the work before the first one included.
[[nodiscard]] double seconds_per_iteration(const SolverTrial& trial);

/// convergence.csv: one row for every residual that a solver reported.
class ConvergenceLog {
 public:
  /// @throws Error (io).
  explicit ConvergenceLog(const std::filesystem::path& file);
  void add(const CcpRecord& record, const SolverTrial& trial);
  void close() { table_.close(); }

 private:
  CsvWriter table_;
};

/// Writes convergence_<step>_<start>_iterations and ..._time, each as SVG and PNG. Time is that of the undisturbed solve, shared
/// evenly by its iterations. @throws Error (io).
void draw_convergence(const CcpRecord& record, const std::vector<SolverTrial>& trials,
                      const std::filesystem::path& folder);

}  // namespace scree
