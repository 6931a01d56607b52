// Claims on the files of a run: no two parts write the same one, and none writes outside the folder of results.
//
// A part says at setup what it will write; core refuses what another part, or the run itself, has claimed before a step is
// taken, and in `scree check` too.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scree {

class SceneServices;

/// What a run writes itself.
inline constexpr const char* kStepsFile = "steps.csv";
inline constexpr const char* kRemovedFile = "removed.csv";
inline constexpr const char* kJointsFile = "joints.csv";
inline constexpr const char* kRunFile = "run.json";
inline constexpr const char* kCheckpointFile = "checkpoint.h5";
inline constexpr const char* kLastStateFile = "last_good_state.h5";  ///< of a run that failed

/// Who writes what. A `*` in the name of a file stands for a number.
class ResultClaims {
 public:
  /// Starts with the files that the run itself writes.
  ResultClaims();

  /// Why `file` is no name for a file in the folder of results: goes on from "'NAME' "; empty when it is one.
  [[nodiscard]] static std::string fault_of(std::string_view file);
  /// Notes that `owner` writes `file`. The owner who claimed it before, who keeps it; empty when there is none.
  std::string claim(const std::string& owner, const std::string& file);
  /// True when some owner has claimed this file.
  [[nodiscard]] bool has(std::string_view file) const;

 private:
  std::vector<std::pair<std::string, std::string>> claims_;  // owner, file
};

/// What services offer beside SceneServices when they keep claims.
class ResultRegistry {
 public:
  virtual ~ResultRegistry();
  /// The calling part will write `file`. @throws Error (usage) at the part's place in the scene when it must not.
  virtual void claim_result(const std::string& file) = 0;
};

/// For parts, at setup, whether or not the run writes results: claims STEM with each of the endings, such as "_series.csv".
/// Nothing happens with services that keep no claims. @throws Error (usage).
void claim_results(SceneServices& services, std::string_view stem, const std::vector<std::string>& endings);

}  // namespace scree
