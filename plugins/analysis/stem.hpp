// Stem: what the files of an observer are called.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

class SceneServices;

/// TYPE for an observer without a name of its own, else TYPE_NAME, in the folder of results; nothing when a run writes none.
class Stem {
 public:
  Stem() = default;
  /// Claims the stem with each of the endings, of all files that the observer writes (scree/results/result_claims.hpp).
  Stem(std::string_view type, SceneServices& services, const std::filesystem::path& results,
       const std::vector<std::string>& endings);

  [[nodiscard]] bool writes() const { return !stem_.empty(); }
  /// The table STEM.csv, or STEM_PART.csv; an empty path when nothing is written.
  [[nodiscard]] std::filesystem::path table(std::string_view part = {}) const;
  /// The stem of a figure: STEM, or STEM_PART. Only when something is written.
  [[nodiscard]] std::filesystem::path figure(std::string_view part = {}) const;

 private:
  std::filesystem::path stem_;
};

}  // namespace scree
