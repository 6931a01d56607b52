// What `scree compare` was asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree {

/// The arguments of `scree compare`.
struct CompareOptions {
  std::filesystem::path scene;
  std::filesystem::path output;              ///< folder for tables and plots
  std::vector<std::string> overrides;        ///< "key=value" of the scene
  std::vector<std::string> plugin_dirs;      ///< searched before all others
  std::string vary;                          ///< what differs: a section of the scene, or a setting "section.key"
  std::vector<std::string> values;           ///< of what differs
  std::vector<std::string> broad_phases;     ///< to try; empty for the scene's
  std::vector<std::string> narrow_phases;    ///< chains to try, "a+b"; empty for the scene's
  std::vector<double> times;                 ///< [s]; empty for the end of the scene
  std::vector<std::string> solver_settings;  ///< "solver.key=value"
  std::optional<double> tolerance;           ///< of the solvers [m/s]; else the scene's
  std::optional<int> max_iterations;         ///< of the solvers; else the scene's
  int threads = 1;
  bool overwrite = false;
  bool quiet = false;

  /// The overrides, and no observers: they see nothing of a comparison, and their files would only cost time.
  [[nodiscard]] std::vector<std::string> overrides_without_observers() const {
    std::vector<std::string> out = overrides;
    out.emplace_back("observer=[]");
    return out;
  }
};

/// Runs the scene to the times asked for, and gives the contact problems of these steps to every solver, cold and warm.
/// Prints a table; writes comparison.csv, convergence.csv, the problems and plots. Returns the exit code.
/// @throws Error.
[[nodiscard]] int compare_solvers(const CompareOptions& options);

/// Runs the scene to the times asked for, and gives the bodies of these moments to every broad phase with every chain of
/// narrow phases. Prints a table; writes comparison.csv and a plot. Returns the exit code. @throws Error.
[[nodiscard]] int compare_phases(const CompareOptions& options);

/// Runs the whole scene once for every value. Prints a table; writes comparison.csv. Returns the exit code.
/// @throws Error.
[[nodiscard]] int compare_runs(const CompareOptions& options);

}  // namespace scree
