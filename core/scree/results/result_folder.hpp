// ResultFolder: the folder that a run writes into.
#pragma once

#include <filesystem>
#include <string_view>

namespace scree {

/// A folder that belongs to one run. An older run is never overwritten by accident.
class ResultFolder {
 public:
  /// Makes the folder. When it exists and holds something, `overwrite` is needed; then what an older run of scree
  /// wrote is removed, and nothing else.
  /// @throws Error (io) for a folder that holds results and `overwrite` is not given, that holds files but no results
  /// of scree, or that cannot be made; the sentence says what to do.
  static ResultFolder create(const std::filesystem::path& folder, bool overwrite);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

 private:
  explicit ResultFolder(std::filesystem::path path) : path_{std::move(path)} {}
  std::filesystem::path path_;
};

/// True for the names that runs write: run.json, steps.csv, bins_*, particles_*.vtp, checkpoint.h5, ...
[[nodiscard]] bool is_result_name(std::string_view name);

}  // namespace scree
