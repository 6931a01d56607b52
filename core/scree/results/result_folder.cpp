#include "scree/results/result_folder.hpp"

#include <fstream>
#include <system_error>

#include "scree/base/error.hpp"
#include "scree/results/output_file.hpp"

namespace scree {

namespace fs = std::filesystem;

namespace {

// Says that the folder is scree's, from the first moment of a run on, and lists what the run wrote, one name a line.
constexpr const char* kMarker = ".scree_results";
constexpr const char* kMarkerText =
    "This folder holds results of scree. `--overwrite` removes the files below, and nothing else.\n";

// Only plain names are removed, whatever somebody wrote into the list.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find_first_of("/\n") == std::string::npos;
}

void remove_old_results(const fs::path& folder) {
  std::ifstream list{folder / kMarker};
  std::string name;
  std::getline(list, name);  // what the list is
  while (std::getline(list, name)) {
    if (!is_plain_name(name)) continue;
    for (const char* end : {"", kPartOfFile}) {
      const fs::path file = folder / (name + end);
      if (fs::is_regular_file(fs::symlink_status(file))) fs::remove(file);
    }
  }
}

void refuse_foreign(const fs::path& folder) {
  if (fs::exists(folder / kMarker)) return;
  throw Error{ErrorKind::io, "the folder " + folder.string() +
                                 " holds files, but no results of scree, so that --overwrite does not apply; choose "
                                 "another folder with -o."};
}

}  // namespace

void list_result(const fs::path& file) {
  const fs::path folder = file.parent_path();
  std::error_code ignored;
  fs::path name = file.filename();
  if (name == kMarker || fs::exists(file, ignored) || !fs::exists(folder / kMarker, ignored)) return;
  if (name.extension() == kPartOfFile) name.replace_extension();
  if (name != file.filename() && fs::exists(folder / name, ignored)) return;
  if (is_plain_name(name.string())) std::ofstream{folder / kMarker, std::ios::app} << name.string() + "\n";
}

std::string lower_snake(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))) c = '_';
  }
  return name;
}

std::string result_stem(std::string_view stem, std::string_view type, std::string_view name) {
  return std::string{stem} + (name.empty() || name == type ? "" : "_" + lower_snake(std::string{name}));
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
