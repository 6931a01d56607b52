#include "problem_file.hpp"

#include <fmt/format.h>

#include "scree/base/error.hpp"
#include "scree/ccp/fclib/fclib_export.hpp"
#include "scree/ccp/fclib/fclib_file.hpp"

namespace scree {

ProblemFile::ProblemFile(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto refuse = [&](const std::string& what) { throw Error{ErrorKind::io, name + " " + what}; };
  const std::string needed = "; a contact problem of scree or of FCLIB is needed";
  if (!std::filesystem::exists(file)) throw Error{ErrorKind::io, "there is no contact problem " + name};
  switch (problem_kind(file)) {
    case ProblemKind::fclib:
      fclib_.emplace(read_fclib_file(file), name);
      break;
    case ProblemKind::scree:
      record_ = read_ccp_file(file);
      break;
    case ProblemKind::no_hdf5:
      refuse("is not an HDF5 file" + needed);
      break;
    case ProblemKind::damaged:
      refuse("is damaged or cut short" + needed);
      break;
    case ProblemKind::other:
      refuse(
          "holds neither a contact problem of scree nor one of FCLIB: it has no group \"fclib_local\" or "
          "\"fclib_global\"");
  }
}

std::string ProblemFile::headline() const {
  if (!fclib_) {
    return fmt::format("{} bodies, {} contacts, {} blocks, step {} at {:.6g} s", record_.inverse_mass.size(),
                       record_.contacts.size(), record_.blocks.size(), record_.origin.step, record_.origin.time);
  }
  const FclibProblem& problem = fclib_->source();
  return fmt::format("{}{}{} contacts of {} rows, {} bilateral constraints", problem.info.title,
                     problem.info.title.empty() ? "" : ": ", problem.contacts(), problem.rows_per_contact(),
                     problem.bilateral_rows());
}

void ProblemFile::write_solution(const std::filesystem::path& file, std::span<const double> gamma) const {
  FclibProblem out;
  if (fclib_) {
    out = fclib_->source();
    out.solution = fclib_->solution(gamma);
  } else {
    out = export_to_fclib(record_.problem(), gamma);
    out.info.description = headline();
  }
  write_fclib_file(file, out);
}

}  // namespace scree
