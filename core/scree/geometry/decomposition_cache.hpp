// DecompositionCache: sphere decompositions by the content of what was decomposed, so that a shape costs once.
//
// Content is the solid itself, scaled to size one (corners, triangles, planes), the number of spheres and the settings: the
// same particle in another size, in another body or in another scene is the same content. Decompositions are deterministic, so
// that a kept one and a new one do not differ in a bit.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <string>

#include "scree/geometry/sphere_decomposition.hpp"

namespace scree {

/// Keeps decompositions in memory and, if told a folder, on disk. Safe from several threads; what one thread computes
/// another waits for.
class DecompositionCache {
 public:
  /// The one of this program, which decompose_box() and its like ask. In memory only, until keep_in() is called.
  static DecompositionCache& of_program();

  /// Looks into `folder` from now on, and writes there; an empty path keeps to memory. A file that cannot be read or written,
  /// or whose check sum is wrong, is passed over: it costs time and nothing else.
  void keep_in(std::filesystem::path folder);

  /// What `compute` returns for this content, or returned before. `content` are the bytes of all that the answer depends on.
  [[nodiscard]] SphereDecomposition find_or(const std::string& content,
                                            const std::function<SphereDecomposition()>& compute);

  /// How often a decomposition was computed, found in memory, and found on disk.
  struct Counts {
    std::size_t computed = 0, remembered = 0, read = 0;
  };
  [[nodiscard]] Counts counts() const;
  /// Forgets what is in memory, not what is on disk.
  void forget();

 private:
  mutable std::mutex mutex_;
  std::filesystem::path folder_;
  std::map<std::string, std::shared_future<SphereDecomposition>> known_;  // by hash of the content
  Counts counts_;
};

/// The folder that the variable SCREE_CACHE names, for programs to keep decompositions in; empty when it is not set.
[[nodiscard]] std::filesystem::path user_cache_folder();

}  // namespace scree
