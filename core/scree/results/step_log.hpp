// StepLog and RemovedLog: steps.csv and removed.csv of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scree/interfaces/observer.hpp"
#include "scree/results/csv.hpp"
#include "scree/results/energy_account.hpp"

namespace scree {

class Materials;

/// One line of steps.csv.
struct StepRecord {
  std::uint64_t step = 0;         ///< steps done
  double time = 0.0;              ///< at the end of the step [s]
  std::uint64_t bodies = 0;       ///< dynamic ones
  std::uint64_t contacts = 0;     ///< given to the solver
  std::uint64_t iterations = 0;   ///< of the solver; sub-steps where no contact problem is solved
  double residual = 0.0;          ///< of the solver, as core judges it [m/s]
  std::string status;             ///< of the solver: "converged", ...
  double mean_penetration = 0.0;  ///< over closed contacts, relative to the smaller body's radius [1]
  double max_penetration = 0.0;   ///< [m]
  std::uint64_t fallbacks = 0;    ///< pairs that a narrow phase computed by its fallback
  EnergyAccount energy;
};

/// Writes steps.csv.
class StepLog {
 public:
  /// `phases` name the parts of a step whose wall time is logged. @throws Error (io).
  StepLog(const std::filesystem::path& file, const std::vector<std::string>& phases);
  /// `phase_seconds` [s]: as many as phases. @throws Error (io).
  void add(const StepRecord& record, std::span<const double> phase_seconds);
  void close() { table_.close(); }

 private:
  CsvWriter table_;
};

/// Writes removed.csv: every body that a sink took, where, when and why.
class RemovedLog {
 public:
  /// @throws Error (io).
  RemovedLog(const std::filesystem::path& file, const Materials& materials);
  void add(std::span<const RemovedBody> removed);
  void close() { table_.close(); }

 private:
  const Materials& materials_;
  CsvWriter table_;
};

}  // namespace scree
