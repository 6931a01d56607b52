// What `scree run` was asked for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree {

/// The arguments of `scree run`.
struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path output;  ///< result folder; empty: beside nothing, in the working directory, after the scene
  std::vector<std::string> overrides;    ///< "key=value"
  std::vector<std::string> plugin_dirs;  ///< searched before all others
  int threads = 0;                       ///< 0: as many as the machine has
  std::optional<double> end_time;        ///< [s]
  std::filesystem::path resume;          ///< checkpoint to continue from; empty for none
  std::vector<double> record_ccp;        ///< times whose contact problems are kept [s]
  bool overwrite = false;
  bool quiet = false;
  bool profile = false;
};

}  // namespace scree
