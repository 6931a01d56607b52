// RunRecord: what run.json says about a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scree/interfaces/observer.hpp"

namespace scree {

/// A plugin that took part.
struct PluginRecord {
  std::string kind;
  std::string name;
  std::string version;
  std::string file;  ///< its library
};

/// Filled in by the program while a run goes on; written at its end, whatever the end is.
struct RunRecord {
  int exit_status = 0;          ///< the program's exit code
  std::string outcome;          ///< one sentence: how the run ended
  double simulated_time = 0.0;  ///< [s]
  std::uint64_t steps = 0;
  double wall_time = 0.0;        ///< [s]
  std::uint64_t bodies = 0;      ///< at the end
  std::uint64_t contacts = 0;    ///< of the last step
  std::uint64_t state_hash = 0;  ///< of every bit of the bodies at the end; a hexadecimal string in the file

  std::string scene_file;
  std::string scene_hash;
  std::string resolved_scene;  ///< JSON text with every default; other text is kept as a string
  std::string scree_version;
  std::string compiler;
  std::uint64_t seed = 0;
  int threads = 1;
  double time_step = 0.0;  ///< outer [s]

  std::vector<PluginRecord> plugins;
  std::vector<std::pair<std::string, double>> phase_seconds;  ///< wall time by phase [s], in order
  std::vector<std::pair<std::string, double>> measures;       ///< other numbers; the unit stands in the name: "x [m]"
  std::vector<std::string> log;                               ///< lines that parts logged
  std::vector<ReportTable> tables;                            ///< of the observers
};

/// The record as JSON text.
[[nodiscard]] std::string to_json(const RunRecord& record);

/// Writes run.json as a whole or not at all. @throws Error (io).
void write_run_record(const RunRecord& record, const std::filesystem::path& file);

/// A hash as 16 hexadecimal digits.
[[nodiscard]] std::string to_hex(std::uint64_t hash);

}  // namespace scree
