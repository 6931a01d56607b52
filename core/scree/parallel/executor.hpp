// Executor: loops over index ranges on several threads, with results that do
// not depend on their number.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace scree {

/// Runs loops in fixed chunks. A chunk's bounds depend on the size of the loop
/// and the grain only, never on the number of threads, so that sums taken chunk
/// by chunk are bit-identical for any number of threads.
class Executor {
 public:
  /// `threads` >= 1; 1 runs everything on the calling thread.
  explicit Executor(int threads);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  [[nodiscard]] int threads() const { return threads_; }

  /// Calls body(first, last) for the chunks [0, grain), [grain, 2 grain), ...
  /// of [0, count), in any order, and waits. The first exception thrown by a
  /// chunk is thrown again here.
  void for_chunks(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t first, std::size_t last)>& body) const;

  /// Number of chunks that for_chunks() makes, for per-chunk results.
  [[nodiscard]] static std::size_t chunk_count(std::size_t count, std::size_t grain) {
    return grain == 0 ? 0 : (count + grain - 1) / grain;
  }

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace scree
