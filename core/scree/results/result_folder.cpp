#include "scree/results/result_folder.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "scree/base/error.hpp"
#include "scree/results/output_file.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

// Says that the folder is scree's, from the first moment of a run on.
constexpr const char* kMarker = ".scree_results";
constexpr const char* kMarkerText =
    "This folder holds results of scree. `--overwrite` removes what a run wrote here, and nothing else.\n";

struct ResultPattern {
  std::string_view begin, end;
};
constexpr std::array kPatterns{
    ResultPattern{"run", ".json"},       ResultPattern{"steps", ".csv"},  ResultPattern{"removed", ".csv"},
    ResultPattern{"bins_", ".csv"},      ResultPattern{"bins_", ".svg"},  ResultPattern{"bins_", ".png"},
    ResultPattern{"particles_", ".vtp"}, ResultPattern{"walls_", ".vtp"}, ResultPattern{"spheres", ".pvd"},
    ResultPattern{"spheres_", ".vtp"},   ResultPattern{"run", ".pvd"},    ResultPattern{"checkpoint", ".h5"},
    ResultPattern{"report", ".html"},    ResultPattern{"ccp_", ".h5"},    ResultPattern{"checkpoint", ".h5.part"},
    ResultPattern{"run", ".json.part"},  ResultPattern{kMarker, ""},
};

void remove_old_results(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator{folder}) {
    if (entry.is_regular_file() && is_result_name(entry.path().filename().string())) fs::remove(entry.path());
  }
}

void refuse_foreign(const fs::path& folder) {
  if (fs::exists(folder / kMarker) || fs::exists(folder / "run.json")) return;
  throw Error{ErrorKind::io, "the folder " + folder.string() +
                                 " holds files, but no results of scree, so that --overwrite does not apply; choose "
                                 "another folder with -o."};
}

}  // namespace

bool is_result_name(std::string_view name) {
  return std::any_of(kPatterns.begin(), kPatterns.end(), [&](const ResultPattern& pattern) {
    const bool prefix = pattern.begin.ends_with('_');
    if (!prefix)
      return name.size() == pattern.begin.size() + pattern.end.size() && name.starts_with(pattern.begin) &&
             name.ends_with(pattern.end);
    return name.starts_with(pattern.begin) && name.ends_with(pattern.end);
  });
}

ResultFolder ResultFolder::create(const fs::path& folder, bool overwrite) {
  try {
    if (fs::exists(folder) && !fs::is_directory(folder)) {
      throw Error{ErrorKind::io, folder.string() + " is a file; results need a folder, choose another one with -o."};
    }
    fs::create_directories(folder);
    if (!fs::is_empty(folder)) {
      if (!overwrite) {
        throw Error{ErrorKind::io, "the folder " + folder.string() +
                                       " is not empty; choose another one with -o, or replace an older run's results "
                                       "with --overwrite."};
      }
      refuse_foreign(folder);
      remove_old_results(folder);
    }
    replace_file(folder / kMarker, std::string_view{kMarkerText});
  } catch (const fs::filesystem_error& failure) {
    throw Error{ErrorKind::io, system_failure("prepare the result folder", folder, failure.code().value())};
  }
  return ResultFolder{folder};
}

}  // namespace scree
