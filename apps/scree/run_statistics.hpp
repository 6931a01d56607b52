// RunStatistics: numbers about a whole run, for run.json and the terminal.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scree/interfaces/observer.hpp"
#include "scree/results/step_log.hpp"
#include "scree/simulation/simulation.hpp"

namespace scree {

/// Means and extremes over the steps of a run.
class RunStatistics {
 public:
  /// `is_soft`: no contact problem is solved, and steps are divided into sub-steps.
  explicit RunStatistics(bool is_soft) : is_soft_{is_soft} {}
  void add(const StepRecord& step);
  /// Name with unit, and value.
  [[nodiscard]] std::vector<std::pair<std::string, double>> measures() const;
  [[nodiscard]] const StepRecord& last() const { return last_; }
  [[nodiscard]] bool is_soft() const { return is_soft_; }
  /// Over all steps; 0 where contact problems are solved [1].
  [[nodiscard]] double mean_sub_steps() const;

 private:
  bool is_soft_;
  StepRecord last_;
  std::uint64_t steps_ = 0;
  std::uint64_t steps_in_contact_ = 0;
  std::uint64_t most_contacts_ = 0;
  std::uint64_t most_bodies_ = 0;
  std::uint64_t fallbacks_ = 0;
  double contacts_ = 0.0;          // sum over steps [1]
  double sub_steps_ = 0.0;         // sum over steps [1]
  double iterations_ = 0.0;        // sum over steps with contacts [1]
  double residual_ = 0.0;          // sum over steps with contacts [m/s]
  double largest_residual_ = 0.0;  // [m/s]
  double mean_penetration_ = 0.0;  // sum over steps, weighted with contacts [1]
  double max_penetration_ = 0.0;   // [m]
};

/// What the contacts cost and how well they were solved, for the terminal: numbers of the measures above, each with its
/// unit, and the shares of the wall time, that of the solver where there is one.
[[nodiscard]] ReportTable work_table(const RunStatistics& statistics, const PhaseTimer& timer);

/// Per material: fed, in flight, removed, by number and mass. In flight is counted from the bodies themselves.
[[nodiscard]] ReportTable balance_table(const Simulation& simulation);

/// Seconds and share by phase of a step.
[[nodiscard]] ReportTable phase_table(const PhaseTimer& timer);

/// A table for the terminal: title, header, rows; columns of numbers to the right.
[[nodiscard]] std::string to_text(const ReportTable& table);

}  // namespace scree
