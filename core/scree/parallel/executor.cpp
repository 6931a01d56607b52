#include "scree/parallel/executor.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "scree/base/require.hpp"

namespace scree {

struct Executor::Arena {
  explicit Arena(int threads) : arena{threads} {}
  oneapi::tbb::task_arena arena;
};

Executor::Executor(int threads) : threads_{threads}, arena_{threads > 1 ? std::make_unique<Arena>(threads) : nullptr} {
  SCREE_REQUIRE(threads >= 1, "an Executor needs at least one thread");
}

Executor::~Executor() = default;

void Executor::for_chunks(std::size_t count, std::size_t grain,
                          const std::function<void(std::size_t, std::size_t)>& body) const {
  SCREE_REQUIRE(grain > 0, "for_chunks needs a grain of at least one");
  const std::size_t chunks = chunk_count(count, grain);
  const auto run = [&](std::size_t chunk) { body(chunk * grain, std::min(count, (chunk + 1) * grain)); };
  if (arena_ == nullptr || chunks < 2) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
    return;
  }
  arena_->arena.execute([&] { oneapi::tbb::parallel_for(std::size_t{0}, chunks, run); });
}

}  // namespace scree
