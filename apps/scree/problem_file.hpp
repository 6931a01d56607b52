// ProblemFile: a contact problem of either kind that `scree solve` takes, told by what the file holds.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "scree/ccp/ccp_file.hpp"
#include "scree/ccp/fclib/fclib_ccp.hpp"

namespace scree {

/// A recorded contact problem, or one of the Frictional Contact Library.
class ProblemFile {
 public:
  /// @throws Error (io) for a file that is missing, damaged, or no contact problem.
  explicit ProblemFile(const std::filesystem::path& file);

  [[nodiscard]] const CcpRecord& record() const { return fclib_ ? fclib_->record() : record_; }
  /// What stands at the head of a report.
  [[nodiscard]] std::string headline() const;
  /// Finds out before the solve whether write_solution() to `file` can do its work. @throws Error (usage) for a name that is not
  /// that of an HDF5 file, and as write_solution().
  void check_solution_file(const std::filesystem::path& file) const;
  /// Writes the problem with its answer, impulses of all rows [N s], as a file of FCLIB. @throws Error (io); (usage) for a
  /// problem with something that FCLIB does not know.
  void write_solution(const std::filesystem::path& file, std::span<const double> gamma) const;

 private:
  CcpRecord record_;
  std::optional<FclibCcp> fclib_;
};

}  // namespace scree
