// ResultFolder: the folder that a run writes into.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace scree {

/// A folder that belongs to one run. An older run is never overwritten by accident.
///
/// The folder's file `.scree_results` lists what the run wrote there: every file that went through OutputFile or
/// replace_file(), whichever part of the program wrote it.
class ResultFolder {
 public:
  /// Makes the folder. When it exists and holds something, `overwrite` is needed; then what an older run of scree
  /// listed as its own is removed, and nothing else.
  /// @throws Error (io) for a folder that holds results and `overwrite` is not given, that holds files but no results
  /// of scree, or that cannot be made; the sentence says what to do.
  static ResultFolder create(const std::filesystem::path& folder, bool overwrite);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

 private:
  explicit ResultFolder(std::filesystem::path path) : path_{std::move(path)} {}
  std::filesystem::path path_;
};

/// Lists a file that is about to be made, when its folder is one of results. Ignores failures: the file matters more.
void list_result(const std::filesystem::path& file);

/// The stem of the files of a part: `stem` alone when the scene gave the part no name of its own (it is then called as
/// its type, or not at all), else `stem`_NAME.
[[nodiscard]] std::string result_stem(std::string_view stem, std::string_view type, std::string_view name);

/// A name as part of a file or column name: lower case letters, digits and underscores.
[[nodiscard]] std::string lower_snake(std::string name);

}  // namespace scree
