#include "problem_file.hpp"

#include <fmt/format.h>

#include "say.hpp"
#include "scree/base/error.hpp"
#include "scree/ccp/count_contacts.hpp"
#include "scree/ccp/fclib/fclib_export.hpp"
#include "scree/ccp/fclib/fclib_file.hpp"
#include "scree/results/output_file.hpp"

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
    const CcpProblem problem = record_.problem();
    const std::size_t contacts = count_contacts(problem);
    return fmt::format("{}, {}, {}, step {} at {:.6g} s", counted(problem.bodies(), "body", "bodies"),
                       counted(contacts, "contact", "contacts"),
                       counted(problem.units() - contacts, "other block", "other blocks"), record_.origin.step,
                       record_.origin.time);
  }
  const FclibProblem& problem = fclib_->source();
  return fmt::format("{}{}{} contacts of {} rows, {} bilateral constraints", problem.info.title,
                     problem.info.title.empty() ? "" : ": ", problem.contacts(), problem.rows_per_contact(),
                     problem.bilateral_rows());
}

void ProblemFile::check_solution_file(const std::filesystem::path& file) const {
  const std::string ending = file.extension().string();
  if (ending != ".hdf5" && ending != ".h5") {
    throw Error{ErrorKind::usage,
                {"--output", 0, 0},
                "'" + file.string() +
                    "' is to hold the problem and its answer as FCLIB does, which is an HDF5 file; end its name in "
                    ".hdf5 or .h5"};
  }
  check_replaceable(file);
  if (!fclib_) check_exportable(record_.problem());
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
